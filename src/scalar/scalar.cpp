#include "hbvm/scalar/scalar.hpp"

#include <cmath>

namespace hbvm {

template <>
double rounded_to<double>(mpfr_srcptr x) {
  return mpfr_get_d(x, MPFR_RNDN);
}

template <>
Quad rounded_to<Quad>(mpfr_srcptr x) {
  BigFloat rest(std::numeric_limits<Quad>::digits);
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
  return result;
}

BigFloat exactly(const Mpfr& x) {
  BigFloat result(mpfr_get_prec(raw(x)));
  mpfr_set(raw(result), raw(x), MPFR_RNDN);
  return result;
}

}  // namespace hbvm
