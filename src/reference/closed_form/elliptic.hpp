#pragma once

#include "scalar/scalar.hpp"

namespace hbvm::core {

/// Elliptic functions and integrals in the digits of the scope. They take the parameter m = kappa^2 and its complement
/// m1 = 1 - m, which cannot be had from m without loss where m is near 1.

/// Jacobi's functions at u, of any parameter m >= 0.
struct JacobiFunctions {
  Mpfr sn, cn, dn;
};
JacobiFunctions jacobi_functions(const Mpfr& u, const Mpfr& m, const Mpfr& m1);

/// kappa sn, kappa cn and dn, which have a meaning for kappa = 0 and kappa = infinity, too.
struct JacobiMultiples {
  Mpfr kappa_sn, kappa_cn, dn;
};
/// Those at u_0 + u from those at u_0, by the addition theorem (Abramowitz and Stegun 16.17): with sn, cn and dn of u,
///
///     S = (S_0 cn dn + C_0 D_0 sn)/d,  C = (C_0 cn - S_0 D_0 sn dn)/d,  D = (D_0 dn - S_0 C_0 sn cn)/d
///
/// where d = 1 - S_0^2 sn^2 = cn^2 + D_0^2 sn^2.
JacobiMultiples advanced(const JacobiMultiples& start, const Mpfr& m, const Mpfr& m1, const Mpfr& u);

/// am(u), sn u = sin am(u), which grows with u: by the arithmetic-geometric mean (Abramowitz and Stegun 16.4), for
/// 0 <= m <= 1.
Mpfr jacobi_amplitude(const Mpfr& u, const Mpfr& m, const Mpfr& m1);

/// Carlson's symmetric integrals by duplication (Numerical Algorithms 10, 1995):
///
///     R_F = 1/2 int_0^inf ds / sqrt((s+x)(s+y)(s+z))
///     R_J = 3/2 int_0^inf ds / ((s+p) sqrt((s+x)(s+y)(s+z)))
///
/// of x, y, z >= 0, at most one of them 0, and p > 0.
Mpfr carlson_rf(Mpfr x, Mpfr y, Mpfr z);
Mpfr carlson_rj(Mpfr x, Mpfr y, Mpfr z, Mpfr p);

/// int dphi / sqrt(1 - m sin^2 phi) from 0 to phi, the u with am(u) = phi, of any phi; below pi/2 if m = 1.
Mpfr elliptic_first(const Mpfr& phi, const Mpfr& m1);

/// What the integral of the third kind exceeds that of the first by,
///
///     int_0^u (1/(1 - n sn^2) - 1) du = int_0^phi n sin^2 / ((1 - n sin^2) sqrt(1 - m sin^2)),  phi = am(u)
///
/// for n < 1 with its complement n1 = 1 - n, and phi as great as one likes.
class EllipticThird {
 public:
  EllipticThird(const Mpfr& n, const Mpfr& n1, const Mpfr& m1);
  Mpfr at(const Mpfr& phi) const;

 private:
  Mpfr n_, n1_, m1_, complete_;
};

/// Stumpff's functions c_1, c_2, c_3 of x, positive or not, with c_0 = cos sqrt x. c_k(x) = sum_j (-x)^j / (k + 2 j)!,
/// so that c_1 = sin(sqrt x)/sqrt x.
struct StumpffFunctions {
  Mpfr c0, c1, c2, c3;
};
StumpffFunctions stumpff_functions(const Mpfr& x);

}  // namespace hbvm::core
