#pragma once

#include <cmath>
#include <limits>

#include "scalar/mpfr.hpp"

namespace hbvm::core {

/// log2 |x|, -infinity for 0: a double holds that of any number.
inline double log2_of(const Mpfr& x) {
  if (x == 0) return -std::numeric_limits<double>::infinity();
  long exponent = 0;
  const double fraction = mpfr_get_d_2exp(&exponent, raw(x), MPFR_RNDN);
  return std::log2(std::abs(fraction)) + static_cast<double>(exponent);
}

/// log10 |x| likewise.
inline double log10_of(const Mpfr& x) { return log2_of(x) / std::log2(double{10}); }

/// 2^log2, its fraction rounded to double.
inline Mpfr power_of_two(double log2) {
  const double whole = std::floor(log2);
  Mpfr x = 0;
  mpfr_set_d(raw(x), std::exp2(log2 - whole), MPFR_RNDN);
  mpfr_mul_2si(raw(x), raw(x), static_cast<long>(whole), MPFR_RNDN);
  return x;
}

}  // namespace hbvm::core
