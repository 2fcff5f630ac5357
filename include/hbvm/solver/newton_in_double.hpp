#pragma once

#include "hbvm/solver/extrapolation.hpp"
#include "hbvm/solver/jacobian.hpp"
#include "hbvm/solver/stage_solver.hpp"

namespace hbvm {

/// Simplified Newton iteration for the stage equations in double: for double itself, and for the start and the
/// Jacobian of the mixed-precision Newton iteration.
///
/// A Jacobian is kept while the increments fall by `slow` or more a sweep, also from step to step, and is evaluated
/// anew where they do not. The iteration starts from the extrapolation of the last steps' solutions, or if that leads
/// nowhere (and in the first step) from the constant v = p0, or from the solution of a step half as long.
class NewtonInDouble {
 public:
  static constexpr long max_sweeps = 60;

  NewtonInDouble(const Problem<double>& problem, const Hbvm<double>& method, double step);

  /// \return the number of residuals
  /// \throws StageFailure
  long solve(const Vector<double>& q0, const Vector<double>& p0);
  /// Evaluates the Jacobian at the solution. \return false if it is singular
  [[nodiscard]] bool refresh();

  const StageUnknowns<double>& unknowns() const { return x_; }
  Jacobian& jacobian() { return jacobian_; }
  const Jacobian& jacobian() const { return jacobian_; }
  StageEquations<double>& equations() { return equations_; }
  const StageEquations<double>& equations() const { return equations_; }
  /// What the solution's momenta change over the step: h (psi_0 - zeta_0).
  const Vector<double>& momentum_change() const { return momentum_change_; }
  /// The change of h (psi_0 - zeta_0) when gamma changes by -correction, where the residual was `momentum`: row 0 of
  /// X_s^-1 (momentum - correction), since gamma - e_1 p0 = h X_s (psi - zeta).
  void add_change_of_momentum(const Matrix<double>& momentum, const Matrix<double>& correction,
                              Vector<double>& change) const;

 private:
  enum class Start { previous, constant, shorter };
  void prepare(Start start, const Vector<double>& p0);
  /// The step shortened: its solution, from ever longer steps, is the start for the full one.
  long grow(const Vector<double>& q0, const Vector<double>& p0);
  long iterate(StageEquations<double>& equations, Jacobian& jacobian);

  const Problem<double>& problem_;
  const Hbvm<double>& method_;
  StageEquations<double> equations_;
  Jacobian jacobian_;
  bool usable_ = false;  ///< the Jacobian
  StageUnknowns<double> x_;
  StageResidual<double> residual_;
  Matrix<double> momentum_;  ///< residual before it is solved for
  Vector<double> first_row_of_inverse_X_, momentum_change_, sequence_;
  Extrapolation<double> extrapolation_;
  double tolerance_;
};

}  // namespace hbvm
