#pragma once

#include <Eigen/Core>
#include <complex>
#include <optional>

namespace hbvm::core {

/// What a Runge-Kutta method makes of y' = lambda y, as R(z) = 1 + z b^T (I - z A)^-1 1 with z = lambda h tells.
class LinearStability {
 public:
  LinearStability(Eigen::MatrixXd A, Eigen::VectorXd b);

  /// How far |R| stays at most 1 from 0 in a direction, to 100 at most.
  double interval(std::complex<double> direction) const;
  /// R at infinity; none if A has no inverse.
  std::optional<double> at_infinity() const;
  /// The greatest alpha in degrees with |R| at most 1 where z is within alpha of the negative real axis. 90 is
  /// A-stability. It is seen at points of a thousand sizes on each ray; 0 if the axis itself is not within.
  double angle() const;

 private:
  using Complex = std::complex<double>;

  Complex R(Complex z) const;
  bool is_stable(Complex z) const;
  bool is_stable_along(double degrees) const;

  Eigen::MatrixXd A_;
  Eigen::VectorXd b_;
};

/// Whether b is not negative, nor B A + A^T B - b b^T with B = diag(b). Two solutions of a contractive problem then
/// come nearer at any step.
bool is_algebraically_stable(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

/// The radius of absolute monotonicity: steps up to so many times the Euler method's keep what that keeps, as a norm.
/// 0 if there is none; infinite for what keeps it at any step.
double ssp_coefficient(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

}  // namespace hbvm::core
