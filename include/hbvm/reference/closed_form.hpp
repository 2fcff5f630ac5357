#pragma once

#include <optional>
#include <string>

#include "hbvm/linear/matrix.hpp"

namespace hbvm {

/// A point of an exact motion, to the digits of the scope but the last few.
struct ExactPoint {
  Vector<Mpfr> q, p;
};

/// Jacobi's elliptic functions at u with modulus kappa, 0 <= kappa < 1, by the arithmetic-geometric mean (Abramowitz
/// and Stegun 16.4).
struct JacobiFunctions {
  Mpfr sn, cn, dn;
};
JacobiFunctions jacobi_functions(const Mpfr& u, const Mpfr& kappa);

/// The motion of a built-in scene that is known in closed form:
///
/// - simple_pendulum, (pend)-(pend0): sin(theta/2) = kappa sn(t, kappa), kappa = 1/2, theta from the vertical;
/// - conical_pendulum, (cpend)-(cpend0): a circle of period 2^(3/4) pi.
///
/// \return nothing for any other scene
std::optional<ExactPoint> closed_form(const std::string& scene, const Mpfr& t);
bool has_closed_form(const std::string& scene);

}  // namespace hbvm
