#pragma once

#include <limits>

#include "scalar/scalar.hpp"

namespace hbvm::core {

/// log2 |x| to less than a unit: the e with 2^(e-1) <= |x| < 2^e; of 0, less than that of any number.
/// Sums of a few of them are numbers, too.
inline constexpr long exponent_of_zero = std::numeric_limits<long>::min() / 4;
template <Scalar S>
long binary_exponent(const S& x) {
  if constexpr (std::same_as<S, Quad>)
    if (const binary128::Bits bits = bits_of(x); bits.normal())
      return static_cast<long>(bits.exponent()) - static_cast<long>(binary128::Bits::bias) + 1;
  if (x == 0) return exponent_of_zero;
  if constexpr (std::same_as<S, Mpfr>) {
    return mpfr_get_exp(raw(x));
  } else {
    int exponent = 0;
    using std::frexp;
    frexp(x, &exponent);
    return exponent;
  }
}

/// 2^exponent.
template <Scalar S>
S power_of_two(long exponent) {
  if constexpr (std::same_as<S, Mpfr>) {
    Mpfr x = 1;
    mpfr_mul_2si(raw(x), raw(x), exponent, MPFR_RNDN);
    return x;
  } else {
    using std::ldexp;
    return ldexp(S(1), static_cast<int>(exponent));
  }
}

}  // namespace hbvm::core
