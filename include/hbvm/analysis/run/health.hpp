#pragma once

#include <string>
#include <vector>

#include "hbvm/integrate/coefficient_decay.hpp"
#include "hbvm/integrate/constraint_angles.hpp"
#include "hbvm/integrate/energy_balance.hpp"
#include "hbvm/integrate/hidden_cosines.hpp"
#include "hbvm/integrate/time_grid.hpp"
#include "hbvm/problem/general_drift.hpp"
#include "hbvm/step/method.hpp"

namespace hbvm {

/// A finding that a user should know of: "energy_lost" and what was seen, when, and what to do.
struct Warning {
  std::string name, text;
};

/// What a run is worth, as decimal text.
struct Health {
  std::string condition;     ///< of the Gram matrix of the normalised gradients, where these came closest to dependence
  std::string worst_e_H;     ///< |H_n - H_0| over the greatest term of H
  std::string worst_hidden;  ///< the greatest cosine of HiddenCosines
  std::vector<Warning> warnings;
};

/// Watches a run and says in the end what it is worth. It looks at every mesh point, and at the solution of every step
/// through decay(). The warnings, all of them invariant under powers of two of the units:
///
/// energy_lost: the error of H exceeds 64 sqrt(N) epsilon R for N steps, where R is the greatest term of H, or what
/// rounding q changes H by, plus what the constraint forces could do in a step. A few roundings a step, of either sign,
/// add up by the square root (Brouwer's law); 64 leaves room for the sums within a step.
///
/// constraints_lost: a constraint that is not quadratic moved by more than 64 sqrt(N) units of its round-off: with that
/// many nodes the method does not keep it.
///
/// hidden_constraint_large: worst_hidden exceeds 1/100, and the output state is no small correction of the propagated
/// one.
///
/// near_singular_constraints: ConstraintAngles saw a passage that the steps do not resolve, or the condition exceeds
/// 1/sqrt(epsilon), which leaves fewer than half of the digits of lambda.
///
/// even_s_drift: s is even, and some hidden constraint grew over the quarters of the run, twofold from the first to the
/// last or more, above 64 sqrt(N) epsilon times the condition.
///
/// step_too_large: CoefficientDecay exceeds its limit.
template <Scalar S>
class HealthWatch final : public Observer<S> {
 public:
  /// The problem must outlive it; N is that of the grid.
  HealthWatch(const Problem<S>& problem, const Method& method, const TimeGrid<S>& grid);

  void observe(const Snapshot<S>& snapshot) override;
  /// What decay() has seen is the stepper's to remember, which shows it.
  void remember(Archive& archive) override {
    archive(q_, v_, energy_, drift_, moved_, seen_, angles_, hidden_, condition_);
  }
  CoefficientDecay<S>& decay() { return decay_; }

  /// With the method of the run in the end: its k decides what is said of a lost energy.
  Health report(const Method& method);

 private:
  void report_energy(Health& health, const Method& method);
  void report_drift(Health& health, const Method& method);
  void report_constraints(Health& health);
  void report_hidden(Health& health);
  void report_steps(Health& health);
  const std::string& name(Index constraint) const {
    return problem_.constraints[static_cast<std::size_t>(constraint)].name;
  }

  const Problem<S>& problem_;
  int s_;  ///< of HBVM, 0 of other methods
  S h_;
  long steps_;
  ConstraintGradient<S> gradient_;
  Vector<S> q_, v_;  ///< of the last mesh point
  EnergyBalance<S> energy_;
  GeneralDrift<S> drift_;
  S moved_ = 0;        ///< the most it showed, in units
  bool seen_ = false;  ///< the start
  ConstraintAngles<S> angles_;
  HiddenCosines<S> hidden_;
  CoefficientDecay<S> decay_;
  double condition_ = 1;
};

/// One line each: the figures, then the warnings.
std::string to_text(const Health& health);

#define HBVM_DECLARE(S) extern template class HealthWatch<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DECLARE)
#undef HBVM_DECLARE

}  // namespace hbvm
