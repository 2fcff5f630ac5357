#pragma once

#include <string>
#include <vector>

#include "hbvm/run.hpp"
#include "integrate/coefficient_decay.hpp"
#include "integrate/constraint_angles.hpp"
#include "integrate/constraint_drift.hpp"
#include "integrate/energy_balance.hpp"
#include "integrate/hidden_cosines.hpp"
#include "integrate/time_grid.hpp"
#include "problem/general_drift.hpp"
#include "step/halving_stepper.hpp"
#include "step/method.hpp"

namespace hbvm::core {

/// Watches a run and says in the end what it is worth. It looks at every mesh point, and at the solution of every step
/// through decay(). The warnings, all of them invariant under powers of two of the units. Of every method, by what was
/// seen:
///
/// energy_changed: H is off by more than 1/20 of the kinetic energy, as EnergyChange has it.
///
/// constraint_drift: a constraint is off by more than 1/100, as ConstraintDrift has it; a rod by more than that of its
/// length.
///
/// steps_divided: of the steps made more than half were parts of steps that failed, or some were less than a thousandth
/// of the step. A part is as long as the stage equations can just be solved: of its error that says nothing.
///
/// hidden_constraint_large: worst_hidden exceeds 1/100, and the output state is no small correction of the propagated
/// one.
///
/// near_singular_constraints: ConstraintAngles saw a passage that the steps do not resolve, or the condition exceeds
/// 1/sqrt(epsilon). The latter leaves fewer than half of the digits of lambda.
///
/// step_too_large: CoefficientDecay exceeds its limit.
///
/// Of methods that conserve H or constraints:
///
/// energy_lost: the error of H exceeds 64 sqrt(N) epsilon R for N steps and terms of H. R is the greatest term of H, or
/// what rounding q changes H by, plus what the constraint forces could do in a step. A few roundings a step, of either
/// sign, add up by the square root (Brouwer's law); 64 leaves room for the sums within a step.
///
/// constraints_lost: a constraint that is not quadratic moved by more than 64 sqrt(N) units of its round-off. With that
/// many nodes the method does not keep it.
///
/// even_s_drift: s is even, and some hidden constraint grew from quarter to quarter of the run. It grew twofold or more
/// from the first to the last, above 64 sqrt(N) epsilon times the condition.
template <Scalar S>
class HealthWatch final : public Observer<S> {
 public:
  /// The problem must outlive it; N is that of the grid.
  HealthWatch(const Problem<S>& problem, const Method& method, const TimeGrid<S>& grid);

  void observe(const Snapshot<S>& snapshot) override;
  /// What decay() has seen is the stepper's to remember, which shows it.
  void remember(Archive& archive) override {
    archive(q_, v_, energy_, drift_, moved_, seen_, constraints_, angles_, hidden_, condition_);
  }
  CoefficientDecay<S>& decay() { return decay_; }

  /// The health of a run by the method that was asked for, and by that which became of it. The k of the latter decides
  /// what is said of a lost energy. `halving` is what was done to steps that failed, if they might be divided.
  Health report(const Method& asked, const Method& method, const HalvingLog* halving);

  /// What was seen until now, and what to do: "H had changed by more than 1/20 of the kinetic energy from t = 3 on:
  /// ...". It is empty if H and the constraints were kept.
  std::string lost();

 private:
  /// What there is to say of how H and the constraints were before t; empty if they were kept till then.
  std::string lost_before(const S& t);
  bool energy_changed(const typename EnergyChange<S>::Change& change);
  void report_change(Health& health, const Method& method);
  void report_halving(Health& health, const HalvingLog& log);
  void report_energy(Health& health, const Method& asked, const Method& method);
  void report_drift(Health& health, const Method& asked, const Method& method);
  void report_constraints(Health& health);
  void report_hidden(Health& health);
  void report_steps(Health& health);
  const std::string& name(Index constraint) const {
    return problem_.constraints[static_cast<std::size_t>(constraint)].name;
  }

  const Problem<S>& problem_;
  int s_;       ///< of HBVM, 0 of other methods
  S step_, h_;  ///< and its magnitude
  long steps_;
  S rounding_;  ///< what the roundings of all steps may add up to, relative to the terms
  ConstraintGradient<S> gradient_;
  Matrix<S> g_;
  Vector<S> q_, v_;  ///< of the last mesh point
  DrivenCourse<S> course_;
  EnergyBalance<S> energy_;
  GeneralDrift<S> drift_;
  S moved_ = 0;        ///< the most it showed, in units
  bool seen_ = false;  ///< the start
  ConstraintDrift<S> constraints_;
  ConstraintAngles<S> angles_;
  HiddenCosines<S> hidden_;
  CoefficientDecay<S> decay_;
  double condition_ = 1;
};

}  // namespace hbvm::core
