#include "scalar/scalar.hpp"

#include <algorithm>
#include <cmath>

namespace hbvm::core {

template <>
double rounded_to<double>(mpfr_srcptr x) {
  return mpfr_get_d(x, MPFR_RNDN);
}

template <>
Mpfr rounded_to<Mpfr>(mpfr_srcptr x) {
  Mpfr result;
  mpfr_set(raw(result), x, MPFR_RNDN);
  return result;
}

BigFloat exactly(double x) {
  BigFloat result(std::numeric_limits<double>::digits);
  mpfr_set_d(raw(result), x, MPFR_RNDN);
  return result;
}

BigFloat exactly(const Mpfr& x) {
  BigFloat result(mpfr_get_prec(raw(x)));
  mpfr_set(raw(result), raw(x), MPFR_RNDN);
  return result;
}

#if HBVM_QUAD

namespace {

constexpr long quad_bits = std::numeric_limits<Quad>::digits;
constexpr long quad_min_exponent = std::numeric_limits<Quad>::min_exponent;  // of a normal number 0.1... x 2^e

/// Significand bits that a binary128 number 0.1... x 2^exponent can have: fewer below the normal range.
long bits_of_quad(long exponent) { return quad_bits - std::max(0L, quad_min_exponent - exponent); }

BigFloat power_of_two(long exponent) {
  BigFloat x(2);
  mpfr_set_ui_2exp(raw(x), 1, exponent - 1, MPFR_RNDN);
  return x;
}

}  // namespace

template <>
Quad rounded_to<Quad>(mpfr_srcptr x) {
  const long bits = bits_of_quad(mpfr_regular_p(x) ? mpfr_get_exp(x) : 0);
  if (bits < 1) {
    // Less than the smallest number: 0, or that number if more than half of it.
    const bool up = bits == 0 && mpfr_cmpabs(x, raw(power_of_two(quad_min_exponent - quad_bits))) > 0;
    const Quad smallest = up ? std::numeric_limits<Quad>::denorm_min() : Quad(0);
    return mpfr_sgn(x) < 0 ? Quad(-smallest) : smallest;
  }
  BigFloat rest(bits);
  mpfr_set(raw(rest), x, MPFR_RNDN);
  if (!mpfr_regular_p(raw(rest))) return Quad(mpfr_get_d(raw(rest), MPFR_RNDN));
  // 113 bits in three doubles, each the leading part of what is left: every operation below is exact. The
  // exponent goes aside first, because binary128 reaches further than double.
  const long exponent = mpfr_get_exp(raw(rest));
  mpfr_set_exp(raw(rest), 0);
  Quad sum = 0;
  for (int part = 0; part < 3; ++part) {
    const double head = mpfr_get_d(raw(rest), MPFR_RNDZ);
    sum += Quad(head);
    mpfr_sub_d(raw(rest), raw(rest), head, MPFR_RNDN);
  }
  return boost::multiprecision::ldexp(sum, static_cast<int>(exponent));
}

BigFloat exactly(const Quad& x) {
  BigFloat result(std::numeric_limits<Quad>::digits);
  if (!isfinite(x) || x == 0) {
    mpfr_set_d(raw(result), static_cast<double>(x), MPFR_RNDN);
    return result;
  }
  int exponent = 0;
  Quad rest = boost::multiprecision::frexp(x, &exponent);
  mpfr_set_zero(raw(result), 1);
  for (int part = 0; part < 3; ++part) {
    const double head = static_cast<double>(rest);
    mpfr_add_d(raw(result), raw(result), head, MPFR_RNDN);
    rest -= Quad(head);
  }
  mpfr_mul_2si(raw(result), raw(result), exponent, MPFR_RNDN);
  mpfr_prec_round(raw(result), bits_of_quad(mpfr_get_exp(raw(result))), MPFR_RNDN);  // exact: fewer bits hold it
  return result;
}

#endif

}  // namespace hbvm::core
