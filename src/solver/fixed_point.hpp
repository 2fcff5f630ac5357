#pragma once

#include "solver/extrapolation.hpp"
#include "solver/position_scale.hpp"
#include "solver/root_check.hpp"
#include "solver/stage_solver.hpp"
#include "solver/stopping_rule.hpp"

namespace hbvm::core {

/// The fixed-point iteration (55) for the stage equations (54).
///
/// In the paper's order a sweep computes all new values from old ones, and the first starts from gamma = psi = 0.
/// Otherwise a sweep uses each value as soon as it is known: psi from gamma, then lambda and zeta, then gamma. The
/// first starts from the extrapolation of the last steps' gamma, and if that leads nowhere, from the constant v = p0.
///
/// StoppingRule says when it ends, from the change of gamma, and in the paper's order, where psi lags, of h psi. If the
/// changes stop falling above what rounding explains, the condition of the constraints may explain it.
///
/// It fails if a change is not finite, if the matrix of (29) is singular, and if the changes stagnate, grow or fall too
/// slowly. A solution that was found after one start had led nowhere, or by less than a bit a sweep, has to pass
/// RootCheck.
template <Scalar S>
class FixedPoint final : public StageSolver<S> {
 public:
  enum class Order { paper, newest };
  /// In a step that takes more sweeps, Newton's iteration is the quicker one.
  static constexpr long slow = 25;

  FixedPoint(const Problem<S>& problem, const Hbvm<S>& method, Order order);

  long solve(const StepStart<S>& start) override;
  const StageUnknowns<S>& unknowns() const override { return x_; }
  const StepChange<S>& change() const override { return change_; }
  SolverCounts counts() const override;
  /// The same in a step of more digits, effects as parts; not the constant forces, which are evaluated once.
  std::vector<PartCount> counts_in_double() const;
  /// The multipliers are where those of the next step start from.
  void remember(Archive& archive) override { archive(h_, extrapolation_, x_.lambda, x_.zeta); }

 private:
  enum class Start { zero, constant };
  void prepare(Start start, const Vector<S>& p0);
  long iterate();
  [[nodiscard]] bool sweep(bool factor);
  /// \return the sweeps that took \throws StageFailure if the solution is another than shorter steps lead to
  long check_root(long sweeps);
  /// Whether the condition of the constraints at q0 explains the changes that are left.
  bool conditioned();

  StageEquations<S> equations_;
  Order order_;
  StageUnknowns<S> x_;
  Matrix<S> gamma_before_, psi_before_;
  Extrapolation<S> extrapolation_;  ///< of gamma
  PositionScale<S> position_scale_;
  StoppingRule<S> rule_;
  RootCheck<S> root_check_;
  Vector<S> positions_;
  StepChange<S> change_;
  PartCount start_count_{"extrapolation"}, increment_count_{"increments and stopping rule"};
  S h_ = 0;  ///< of the last step
};

}  // namespace hbvm::core
