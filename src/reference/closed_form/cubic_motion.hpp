#pragma once

#include "reference/closed_form/elliptic.hpp"

namespace hbvm::core {

/// The roots of z^3 + a z^2 + b z + c, ascending, if all are real.
struct CubicRoots {
  Mpfr z1, z2, z3;
  static CubicRoots of(const Mpfr& a, const Mpfr& b, const Mpfr& c);
};

/// The motion z'^2 = f (z - z_1)(z - z_2)(z - z_3) between -1 <= z_1 and z_2 <= 1, f > 0:
///
///     z = z_1 + (z_3 - z_1) S^2,  S = kappa sn(Omega t + u_0),  Omega^2 = f (z_3 - z_1)/4,
///     kappa^2 = (z_2 - z_1)/(z_3 - z_1)
///
/// where z_1 = z_2 is no exception. With the integrals of 1/(1 + z) and 1/(1 - z), which are of the third kind.
class CubicMotion {
 public:
  /// \param z, rate z and z' at the start; of the rate only the sign matters
  CubicMotion(const CubicRoots& roots, const Mpfr& f, const Mpfr& z, const Mpfr& rate);

  struct Place {
    Mpfr z, rate, above, below;  ///< z, z', 1 + z and 1 - z, none with loss
  };
  Place at(const Mpfr& t) const;
  /// int_0^t dt/(1 + z) and int_0^t dt/(1 - z).
  struct Integrals {
    Mpfr above, below;
  };
  Integrals integrals(const Mpfr& t) const;

 private:
  CubicRoots roots_;
  Mpfr omega_, m_, m1_;
  JacobiMultiples start_;
  Mpfr u0_;
  EllipticThird above_, below_;
  Mpfr above_before_, below_before_;
};

}  // namespace hbvm::core
