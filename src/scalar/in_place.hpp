#pragma once

#include <algorithm>
#include <cmath>

#include "scalar/scalar.hpp"

namespace hbvm::core {

/// A condition of which the compiler is told that no branch can foresee it: what depends on it is chosen without one.
inline bool by_chance(bool condition) {
  return __builtin_expect_with_probability(condition, true, static_cast<double>(1) / 2);
}

/// Arithmetic that writes into an existing value: r = a op b. For Mpfr this is the mpfr call itself, without the
/// temporary (an allocation) that an operator returns; for the others it is the operator.

template <Scalar S>
void set(S& r, const S& a) {
  if constexpr (std::same_as<S, Mpfr>)
    mpfr_set(raw(r), raw(a), MPFR_RNDN);
  else
    r = a;
}

template <Scalar S>
void set_zero(S& r) {
  if constexpr (std::same_as<S, Mpfr>)
    mpfr_set_zero(raw(r), 1);
  else
    r = 0;
}

template <Scalar S>
void set_magnitude(S& r, const S& a) {
  if constexpr (std::same_as<S, Mpfr>)
    mpfr_abs(raw(r), raw(a), MPFR_RNDN);
  else
    r = magnitude(a);
}

/// r = which ? a : b, for double without a branch.
template <Scalar S>
void choose(S& r, bool which, const S& a, const S& b) {
  if constexpr (std::same_as<S, Mpfr>)
    mpfr_set(raw(r), which ? raw(a) : raw(b), MPFR_RNDN);
  else
    r = by_chance(which) ? a : b;
}

template <Scalar S>
void set_sum(S& r, const S& a, const S& b) {
  if constexpr (std::same_as<S, Mpfr>)
    mpfr_add(raw(r), raw(a), raw(b), MPFR_RNDN);
  else
    r = a + b;
}

template <Scalar S>
void set_difference(S& r, const S& a, const S& b) {
  if constexpr (std::same_as<S, Mpfr>)
    mpfr_sub(raw(r), raw(a), raw(b), MPFR_RNDN);
  else
    r = a - b;
}

template <Scalar S>
void set_negative(S& r, const S& a) {
  if constexpr (std::same_as<S, Mpfr>)
    mpfr_neg(raw(r), raw(a), MPFR_RNDN);
  else
    r = -a;
}

template <Scalar S>
void set_product(S& r, const S& a, const S& b) {
  if constexpr (std::same_as<S, Mpfr>)
    mpfr_mul(raw(r), raw(a), raw(b), MPFR_RNDN);
  else
    r = a * b;
}

template <Scalar S>
void set_quotient(S& r, const S& a, const S& b) {
  if constexpr (std::same_as<S, Mpfr>)
    mpfr_div(raw(r), raw(a), raw(b), MPFR_RNDN);
  else
    r = a / b;
}

/// a + b without any rounding, as r + rest with r = fl(a + b) (Moller and Knuth, TwoSum). r and rest are neither a nor
/// b, and t is scratch.
template <Scalar S>
void set_exact_sum(S& r, S& rest, const S& a, const S& b, S& t) {
  set_sum(r, a, b);
  set_difference(t, r, a);     // what of b is in r
  set_difference(rest, r, t);  // what of a is
  set_difference(rest, a, rest);
  set_difference(t, b, t);
  set_sum(rest, rest, t);
}

/// a b without any rounding, as r + rest with r = fl(a b); r and rest are neither a nor b. Not in quad, whose fma takes
/// as long as some twenty products.
template <Scalar S>
requires(!std::same_as<S, Quad>) void set_exact_product(S& r, S& rest, const S& a, const S& b) {
  set_product(r, a, b);
  if constexpr (std::same_as<S, Mpfr>)
    mpfr_fms(raw(rest), raw(a), raw(b), raw(r), MPFR_RNDN);
  else
    rest = std::fma(a, b, -r);
}

/// A number as a loop holds it. A copy stays in a register whatever is written to memory. Of Mpfr it is the number
/// itself, since a copy is an allocation.
template <Scalar S>
using Held = std::conditional_t<std::same_as<S, Mpfr>, const S&, S>;
/// The same of scratch.
template <Scalar S>
using HeldScratch = std::conditional_t<std::same_as<S, Mpfr>, S&, S>;

/// A number of the working precision for use within one kernel, whose value nobody keeps: creating one would allocate.
template <Scalar S>
S& scratch() {
  thread_local S t;
  if constexpr (std::same_as<S, Mpfr>) {
    const mpfr_prec_t bits = mpfr_working_bits();
    if (mpfr_get_prec(raw(t)) != bits) mpfr_set_prec(raw(t), bits);
  }
  return t;
}

/// |a| > |b|.
template <Scalar S>
bool exceeds(const S& a, const S& b) {
  if constexpr (std::same_as<S, Mpfr>)
    return mpfr_cmpabs(raw(a), raw(b)) > 0;
  else
    return magnitude(a) > magnitude(b);
}

/// a > b of sizes, which are not negative.
template <Scalar S>
bool is_greater(const S& a, const S& b) {
  if constexpr (std::same_as<S, Mpfr>)
    return exceeds(a, b);
  else
    return a > b;
}

/// size = max(size, |x|) and size = min(size, other) of numbers that are finite: in double without a branch, where
/// chance decides and none could be foreseen.
template <Scalar S>
void raise_finite(S& size, const S& x) {
  if constexpr (std::same_as<S, Mpfr>) {
    if (exceeds(x, size)) set_magnitude(size, x);
  } else {
    size = std::max(size, magnitude(x));
  }
}

template <Scalar S>
void lower_finite(S& size, const S& other) {
  if constexpr (std::same_as<S, Mpfr>) {
    if (exceeds(size, other)) set(size, other);
  } else {
    size = std::min(size, other);
  }
}

/// r += a b and r -= a b, each rounded twice; `t` is scratch.
template <Scalar S>
void add_product(S& r, const S& a, const S& b, [[maybe_unused]] S& t) {
  if constexpr (std::same_as<S, Mpfr>) {
    mpfr_mul(raw(t), raw(a), raw(b), MPFR_RNDN);
    mpfr_add(raw(r), raw(r), raw(t), MPFR_RNDN);
  } else {
    r = r + a * b;
  }
}

template <Scalar S>
void subtract_product(S& r, const S& a, const S& b, [[maybe_unused]] S& t) {
  if constexpr (std::same_as<S, Mpfr>) {
    mpfr_mul(raw(t), raw(a), raw(b), MPFR_RNDN);
    mpfr_sub(raw(r), raw(r), raw(t), MPFR_RNDN);
  } else {
    r = r - a * b;
  }
}

}  // namespace hbvm::core
