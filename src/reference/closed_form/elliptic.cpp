#include "reference/closed_form/elliptic.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "hbvm/error.hpp"
#include "reference/closed_form/rounds.hpp"
#include "scalar/binary_exponent.hpp"

namespace hbvm::core {
namespace {

/// Rounds in which the digits have doubled to all there are, and some for rounding.
double doublings_of_digits() { return std::log2(static_cast<double>(significand_bits<Mpfr>())) + 4; }

/// Rounds of the arithmetic-geometric mean of 1 and b, 0 < b <= 1. Each halves log(a/b), and from a <= 2 b on c/a is
/// less than its square before.
double rounds_of_mean(const Mpfr& b) {
  return std::log2(2 + std::abs(static_cast<double>(binary_exponent(b)))) + doublings_of_digits();
}

/// Rounds of a duplication of x, y and z. Each divides by 4 what lies `far` from the mean, and lambda is at least the
/// second greatest of them. So after the first round none is less than a quarter of that.
/// \throws IntegrationError if two of them are 0
double rounds_of_duplication(const Mpfr& far, const Mpfr& end, const Mpfr& x, const Mpfr& y, const Mpfr& z) {
  const Mpfr second = std::max(std::min(x, y), std::min(std::max(x, y), z));
  if (!(second > 0)) throw IntegrationError("an elliptic integral of a closed form is infinite");
  if (far == 0) return 0;
  constexpr double few = 4;
  const double drop = static_cast<double>(binary_exponent(far)) - static_cast<double>(binary_exponent(second)) -
                      static_cast<double>(binary_exponent(end));
  return std::max(double{0}, drop) / 2 + few;
}

/// The sixth root of epsilon / 4: at this relative spread the series of degree 5 that ends a duplication has all
/// digits.
Mpfr end_of_duplication() {
  const Mpfr error = epsilon<Mpfr>() / 4;
  Mpfr end = 0;
  mpfr_rootn_ui(raw(end), raw(error), 6, MPFR_RNDN);
  return end;
}

Mpfr spread(const Mpfr& mean, std::initializer_list<const Mpfr*> values) {
  Mpfr greatest = 0;
  for (const Mpfr* x : values) raise_to(greatest, magnitude(Mpfr(mean - *x)));
  return greatest;
}

Mpfr pi() { return 4 * atan(Mpfr(1)); }
/// The multiple of pi next to phi. For m1 = 0 the amplitude never comes to pi/2, whatever it is rounded to.
Mpfr half_turns(const Mpfr& phi, const Mpfr& m1) {
  return m1 == 0 ? Mpfr(0) : Mpfr(floor(Mpfr(phi / pi() + Mpfr(1) / 2)));
}

/// R_C(1, 1 + e), e > -1.
Mpfr carlson_rc(const Mpfr& e) {
  if (e == 0) return 1;
  const Mpfr r = sqrt(magnitude(e));
  return e > 0 ? Mpfr(atan(r) / r) : Mpfr(atanh(r) / r);
}

}  // namespace

Mpfr jacobi_amplitude(const Mpfr& u, const Mpfr& m, const Mpfr& m1) {
  if (m1 == 0) return atan(sinh(u));
  std::vector<Mpfr> ratios;  // c_n / a_n
  Mpfr a = 1, b = sqrt(m1), c = sqrt(m), phi = u;
  const Mpfr negligible = epsilon<Mpfr>();
  Rounds rounds("the arithmetic-geometric mean of a closed form", rounds_of_mean(b));
  while (abs(c) > negligible * a) {
    rounds.next();
    const Mpfr mean = (a + b) / 2, geometric = sqrt(Mpfr(a * b));
    c = (a - b) / 2;
    a = mean;
    b = geometric;
    ratios.push_back(c / a);
    phi *= 2;
  }
  phi *= a;
  for (auto ratio = ratios.rbegin(); ratio != ratios.rend(); ++ratio) phi = (phi + asin(Mpfr(*ratio * sin(phi)))) / 2;
  return phi;
}

JacobiFunctions jacobi_functions(const Mpfr& u, const Mpfr& m, const Mpfr& m1) {
  if (m1 < 0) {
    // The reciprocal modulus, Abramowitz and Stegun 16.11.
    const Mpfr kappa = sqrt(m);
    const JacobiFunctions f = jacobi_functions(Mpfr(u * kappa), Mpfr(1 / m), Mpfr(-m1 / m));
    return {f.sn / kappa, f.dn, f.cn};
  }
  if (m1 == 0) {
    const Mpfr secant = 1 / cosh(u);
    return {tanh(u), secant, secant};
  }
  const Mpfr phi = jacobi_amplitude(u, m, m1);
  JacobiFunctions f{sin(phi), cos(phi), Mpfr(0)};
  f.dn = sqrt(Mpfr(m1 + m * f.cn * f.cn));
  return f;
}

JacobiMultiples advanced(const JacobiMultiples& start, const Mpfr& m, const Mpfr& m1, const Mpfr& u) {
  const JacobiFunctions f = jacobi_functions(u, m, m1);
  const auto& [S, C, D] = start;
  const Mpfr below = f.cn * f.cn + D * D * f.sn * f.sn;
  return {(S * f.cn * f.dn + C * D * f.sn) / below, (C * f.cn - S * D * f.sn * f.dn) / below,
          (D * f.dn - S * C * f.sn * f.cn) / below};
}

Mpfr carlson_rf(Mpfr x, Mpfr y, Mpfr z) {
  const Mpfr first = (x + y + z) / 3, end = end_of_duplication();
  Mpfr far = spread(first, {&x, &y, &z}), dx = first - x, dy = first - y, mean = first;
  Rounds rounds("an elliptic integral of a closed form", rounds_of_duplication(far, end, x, y, z));
  while (far > end * mean) {
    rounds.next();
    const Mpfr rx = sqrt(x), ry = sqrt(y), rz = sqrt(z), lambda = rx * ry + rx * rz + ry * rz;
    for (Mpfr* value : {&x, &y, &z, &mean}) *value = (*value + lambda) / 4;
    for (Mpfr* difference : {&far, &dx, &dy}) *difference /= 4;
  }
  const Mpfr X = dx / mean, Y = dy / mean, Z = -X - Y, E2 = X * Y - Z * Z, E3 = X * Y * Z;
  return (1 - E2 / 10 + E3 / 14 + E2 * E2 / 24 - 3 * E2 * E3 / 44) / sqrt(mean);
}

Mpfr carlson_rj(Mpfr x, Mpfr y, Mpfr z, Mpfr p) {
  const Mpfr end = end_of_duplication();
  Mpfr mean = (x + y + z + 2 * p) / 5, far = spread(mean, {&x, &y, &z, &p});
  Mpfr dx = mean - x, dy = mean - y, dz = mean - z, delta = (p - x) * (p - y) * (p - z), scale = 1, sum = 0;
  if (!(p > 0)) throw IntegrationError("an elliptic integral of a closed form is infinite");
  Rounds rounds("an elliptic integral of a closed form", rounds_of_duplication(far, end, x, y, z));
  while (far > end * mean) {
    rounds.next();
    const Mpfr rx = sqrt(x), ry = sqrt(y), rz = sqrt(z), rp = sqrt(p), lambda = rx * ry + rx * rz + ry * rz;
    const Mpfr d = (rp + rx) * (rp + ry) * (rp + rz);
    sum += scale / d * carlson_rc(Mpfr(delta / (d * d)));
    for (Mpfr* value : {&x, &y, &z, &p, &mean}) *value = (*value + lambda) / 4;
    for (Mpfr* difference : {&far, &dx, &dy, &dz}) *difference /= 4;
    delta /= 64;
    scale /= 4;
  }
  const Mpfr X = dx / mean, Y = dy / mean, Z = dz / mean, P = -(X + Y + Z) / 2, XYZ = X * Y * Z;
  const Mpfr E2 = X * Y + X * Z + Y * Z - 3 * P * P, E3 = XYZ + 2 * E2 * P + 4 * P * P * P,
             E4 = (2 * XYZ + E2 * P + 3 * P * P * P) * P, E5 = XYZ * P * P;
  const Mpfr series = 1 - 3 * E2 / 14 + E3 / 6 + 9 * E2 * E2 / 88 - 3 * E4 / 22 - 9 * E2 * E3 / 52 + 3 * E5 / 26;
  return scale * series / (mean * sqrt(mean)) + 6 * sum;
}

Mpfr elliptic_first(const Mpfr& phi, const Mpfr& m1) {
  const Mpfr turns = half_turns(phi, m1), rest = phi - turns * pi(), s = sin(rest), c = cos(rest),
             first = s * carlson_rf(Mpfr(c * c), Mpfr(c * c + m1 * s * s), Mpfr(1));
  return turns == 0 ? first : Mpfr(first + 2 * turns * carlson_rf(Mpfr(0), m1, Mpfr(1)));
}

EllipticThird::EllipticThird(const Mpfr& n, const Mpfr& n1, const Mpfr& m1)
    : n_(n), n1_(n1), m1_(m1), complete_(m1 > 0 ? Mpfr(n / 3 * carlson_rj(Mpfr(0), m1, Mpfr(1), n1)) : Mpfr(0)) {}

Mpfr EllipticThird::at(const Mpfr& phi) const {
  const Mpfr turns = half_turns(phi, m1_), rest = phi - turns * pi();
  const Mpfr s = sin(rest), s2 = s * s, c = cos(rest), c2 = c * c;
  return 2 * turns * complete_ + n_ / 3 * s2 * s * carlson_rj(c2, Mpfr(c2 + m1_ * s2), Mpfr(1), Mpfr(c2 + n1_ * s2));
}

StumpffFunctions stumpff_functions(const Mpfr& x) {
  if (magnitude(x) > 1) {
    const Mpfr r = sqrt(magnitude(x)), c0 = x > 0 ? cos(r) : cosh(r), c1 = (x > 0 ? sin(r) : sinh(r)) / r;
    return {c0, c1, (1 - c0) / x, (1 - c1) / x};
  }
  StumpffFunctions f{Mpfr(0), Mpfr(0), Mpfr(1) / 2, Mpfr(1) / 6};
  Mpfr even = f.c2, odd = f.c3;
  const Mpfr negligible = epsilon<Mpfr>();
  // Each term is less than a twelfth of the one before.
  Rounds rounds("a series of a closed form", static_cast<double>(significand_bits<Mpfr>()));
  for (long k = 2; magnitude(even) > negligible * f.c2; k += 2) {
    rounds.next();
    even *= -x / ((k + 1) * (k + 2));
    odd *= -x / ((k + 2) * (k + 3));
    f.c2 += even;
    f.c3 += odd;
  }
  f.c0 = 1 - x * f.c2;
  f.c1 = 1 - x * f.c3;
  return f;
}

}  // namespace hbvm::core
