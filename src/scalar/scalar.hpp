#pragma once

#include <concepts>
#include <limits>

#include "scalar/big_float.hpp"
#include "scalar/mpfr.hpp"
#include "scalar/quad.hpp"

namespace hbvm::core {

/// The number types every algorithm here is written for.
template <class S>
concept Scalar = std::same_as<S, double> || std::same_as<S, Quad> || std::same_as<S, Mpfr>;

/// The one list of the scalars of this build: HBVM_FOR_EACH_SCALAR(X) expands X(double) X(Quad) X(Mpfr).
#if HBVM_QUAD
#define HBVM_FOR_EACH_SCALAR(X) X(double) X(::hbvm::core::Quad) X(::hbvm::core::Mpfr)
#else
#define HBVM_FOR_EACH_SCALAR(X) X(double) X(::hbvm::core::Mpfr)
#endif

/// Significand bits of the working precision.
template <Scalar S>
int significand_bits() {
  if constexpr (std::same_as<S, Mpfr>)
    return mpfr_working_bits();
  else
    return std::numeric_limits<S>::digits;
}

/// Decimal digits that every value of the working precision carries: 15, 33, or those of the PrecisionScope.
template <Scalar S>
int digits10() {
  if constexpr (std::same_as<S, Mpfr>)
    return static_cast<int>(Mpfr::thread_default_precision());
  else
    return std::numeric_limits<S>::digits10;
}

/// Distance from 1 to the next larger number: 2^(1 - significand_bits).
template <Scalar S>
S epsilon() {
  if constexpr (std::same_as<S, Mpfr>) {
    Mpfr x = 1;
    mpfr_div_2si(raw(x), raw(x), mpfr_working_bits() - 1, MPFR_RNDN);
    return x;
  } else {
    return std::numeric_limits<S>::epsilon();
  }
}

template <Scalar S>
bool is_finite(const S& x) {
  using std::isfinite;
  return isfinite(x);
}

/// |x| and max(|x|, bound), which every norm here is made of.
template <Scalar S>
S magnitude(const S& x) {
  using std::abs;
  return abs(x);
}

template <Scalar S>
void raise_to(S& bound, const S& value) {
  if (value > bound || value != value) bound = value;  // a NaN wins, so that no norm hides one
}

/// The value of `x`, which may carry any number of bits, rounded once to the working precision.
template <Scalar S>
S rounded_to(mpfr_srcptr x);
template <>
double rounded_to<double>(mpfr_srcptr x);
template <>
Quad rounded_to<Quad>(mpfr_srcptr x);
template <>
Mpfr rounded_to<Mpfr>(mpfr_srcptr x);

/// The value of `x` without any rounding: the result has the significand bits of S.
BigFloat exactly(double x);
BigFloat exactly(const Quad& x);
BigFloat exactly(const Mpfr& x);

/// The double next to x, for displays, plots and start values; never for a result.
template <Scalar S>
double approximately(const S& x) {
  if constexpr (std::same_as<S, Quad>)
    if (double y = 0; binary128::to_double(y, bits_of(x))) return y;
  return static_cast<double>(x);
}

}  // namespace hbvm::core
