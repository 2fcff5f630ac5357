#pragma once

#include "scalar/archive.hpp"
#include "solver/body_scale.hpp"
#include "solver/broyden_updates.hpp"
#include "solver/jacobian.hpp"
#include "solver/momentum_change.hpp"
#include "solver/newton_course.hpp"
#include "solver/position_scale.hpp"
#include "solver/stopping_rule.hpp"

namespace hbvm::core {

/// Newton's iteration for the stage equations of one step. Its Jacobian is kept, also from step to step, as long as
/// NewtonCourse says. A Jacobian that costs as much as 16 sweeps or more is expensive, and BroydenUpdates improve it.
/// For 24 stages it may cost sixty, for 3 seven. The limit is 8 if the solution is a start for more digits, which
/// correct it anyway.
///
/// Where increments grow although the Jacobian is that of the last iterate, the iterate was a step too far. The step is
/// made again, half as long (Deuflhard's natural monotonicity).
///
/// StoppingRule says when it ends. An ill-conditioned problem may magnify rounding above what the rule takes for it:
/// NewtonCourse tells such rounding from increments that fall.
template <Scalar S>
class NewtonIteration {
 public:
  /// A start for more digits is good when increments have come down to what may be rounding. StoppingRule waits longer,
  /// so that the errors of many steps do not add up.
  enum class Wanted { solution, start };
  NewtonIteration(const Problem<S>& problem, const Hbvm<S>& method, Wanted wanted);

  /// The step that starts there but is h long.
  void begin(const StepStart<S>& from, const S& h);
  /// Takes the gamma and lambda that stand in unknowns() to the solution of that step.
  /// \return the number of residuals
  /// \throws StageFailure
  long run();

  StageUnknowns<S>& unknowns() { return x_; }
  const StageUnknowns<S>& unknowns() const { return x_; }
  /// The unknowns from which the last run started.
  const StageUnknowns<S>& start() const { return start_; }
  const StepChange<S>& change() const { return step_change_; }

  StageEquations<S>& equations() { return equations_; }
  const StageEquations<S>& equations() const { return equations_; }
  Jacobian<S>& jacobian() { return jacobian_; }
  const Jacobian<S>& jacobian() const { return jacobian_; }
  /// The next iteration evaluates a new one.
  void forget_jacobian() { usable_ = false; }
  /// Evaluates it at unknowns(). \return false if it is singular
  [[nodiscard]] bool evaluate_jacobian();

  const PartCount& equations_count() const { return equations_count_; }
  const PartCount& increment_count() const { return increment_count_; }
  void remember(Archive& archive) {
    archive(usable_);
    if (usable_) archive(jacobian_);
  }

 private:
  using Verdict = typename StoppingRule<S>::Verdict;

  void evaluate_residual(long sweep);
  /// The residual becomes the correction. \return what the rule says of it
  Verdict find_correction();
  /// Makes the last step from base_ shorter, or takes it back if its Jacobian was an old one.
  void step_back(long sweep);
  /// base_ = x_, and x_ the next iterate.
  void step_on();
  bool is_solution(Verdict verdict);
  /// x_ = base_ - factor correction_.
  void move_from_base(const S& factor);
  [[noreturn]] void fail(FailureCause cause, const char* what, long sweep) const;

  Wanted wanted_;
  StageEquations<S> equations_;
  Jacobian<S> jacobian_;
  bool usable_ = false;  ///< whether the Jacobian may serve the next run
  StageUnknowns<S> x_, start_;
  StageResidual<S> residual_;
  Matrix<S> momentum_;  ///< the residual of gamma (54), which the correction replaces in residual_
  BroydenUpdates<S> updates_;
  StageResidual<S> base_, correction_;  ///< an iterate (gamma, h lambda) and the step from it
  BodyScale<S> base_scale_;
  MomentumChange<S> momentum_change_;
  StepChange<S> step_change_;
  PositionScale<S> position_scale_;
  Vector<S> positions_;
  StoppingRule<S> rule_;
  PartCount equations_count_{"stage equations"}, increment_count_{"increments and stopping rule"};
  long max_sweeps_;
  NewtonCourse<S> course_;
  S t_ = 0;
};

}  // namespace hbvm::core
