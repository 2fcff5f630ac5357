#include "hbvm/analysis/run/health.hpp"

#include <fmt/format.h>

#include <cmath>

#include "hbvm/analysis/choose_k.hpp"
#include "hbvm/problem/regularity.hpp"
#include "hbvm/scalar/text.hpp"
#include "hbvm/step/hbvm_method.hpp"

namespace hbvm {
namespace {

/// 64 sqrt(n) epsilon: a walk of n steps, each of some tens of roundings. Motions without a loss walk 0.1 to 0.2
/// sqrt(n) epsilon (studies/stability, up to 10^7 steps), and a drift that grows with n passes both soon.
template <Scalar S>
S walked_round_off(long steps) {
  using std::sqrt;
  return S(64) * S(sqrt(S(steps))) * epsilon<S>();
}

}  // namespace

template <Scalar S>
HealthWatch<S>::HealthWatch(const Problem<S>& problem, const Method& method, const TimeGrid<S>& grid)
    : problem_(problem),
      s_(as_hbvm(method) ? as_hbvm(method)->name().s : 0),
      h_(magnitude(grid.step())),
      steps_(grid.steps()),
      gradient_(problem, 1),
      q_(problem.m()),
      v_(problem.m()),
      energy_(problem),
      drift_(problem),
      angles_(problem),
      hidden_(problem, grid.steps()),
      decay_(problem, std::max(s_, 1), grid.step()) {}

template <Scalar S>
void HealthWatch<S>::observe(const Snapshot<S>& snapshot) {
  problem_.mass.velocity(lanes(snapshot.p), lanes(v_));
  q_ = snapshot.q;
  energy_.observe(v_, snapshot);
  if (problem_.nu() == 0) return;
  if (!drift_.empty()) {
    if (!seen_) drift_.start(snapshot.q);
    seen_ = true;
    raise_to(moved_, drift_.in_units(snapshot.q));
  }
  gradient_.update(lanes(snapshot.q));
  angles_.observe(gradient_, snapshot);
  hidden_.observe(gradient_, v_, snapshot);
}

template <Scalar S>
void HealthWatch<S>::report_energy(Health& health, const Method& method) {
  const S size = energy_.size(), error = energy_.error();
  const S relative = error == 0 ? S(0) : S(error / size);
  health.worst_e_H = to_scientific(relative, 3);
  const S rounding = energy_.rounding() + h_ * hidden_.power();
  if (!method.kept().energy || !(error > walked_round_off<S>(steps_) * rounding)) return;
  const HbvmMethod* const hbvm = as_hbvm(method);
  const HbvmName of = hbvm ? hbvm->name() : HbvmName{};
  const int k = of.k, s = of.s;
  const std::optional<int> degree = degree_of_U(problem_);
  const bool exact = !hbvm || (degree && 2 * k >= *degree * s);
  health.warnings.push_back(
      {"energy_lost",
       fmt::format(
           "H is off by {} of its greatest term at t = {}, more than rounding explains ({}); {}", health.worst_e_H,
           to_scientific(energy_.t(), 4), to_scientific(S(walked_round_off<S>(steps_) * rounding / size), 1),
           exact
               ? "the method conserves it exactly: take more digits or a smaller step"
               : fmt::format("k = {} nodes do not conserve it: take more, or hbvm:auto,{}, or a smaller step", k, s))});
}

template <Scalar S>
void HealthWatch<S>::report_drift(Health& health, const Method& method) {
  const S limit = walked_round_off<S>(steps_) / epsilon<S>();
  if (!(moved_ > limit)) return;
  const HbvmMethod* const hbvm = as_hbvm(method);
  const int r = hbvm ? hbvm->constraint_nodes(problem_) : 0;
  health.warnings.push_back(
      {"constraints_lost",
       fmt::format("a constraint moved by {} of its terms, more than rounding explains ({}); {}",
                   to_scientific(S(moved_ * epsilon<S>()), 3), to_scientific(S(limit * epsilon<S>()), 1),
                   hbvm ? fmt::format("r = {} nodes do not keep it: take more, hbvm:{},{},R, or hbvm:auto,{}, or a "
                                      "smaller step",
                                      r, hbvm->name().k, s_, s_)
                        : std::string("take a smaller step"))});
}

template <Scalar S>
void HealthWatch<S>::report_constraints(Health& health) {
  condition_ = problem_.nu() == 0 ? 1 : angle_condition(problem_, angles_.closest_q());
  health.condition = to_scientific(condition_, 3);
  const auto& change = angles_.greatest_change();
  if (change.factor >= ConstraintAngles<S>::unresolved)
    health.warnings.push_back(
        {"near_singular_constraints",
         fmt::format("{} of {} changed by a factor of {:.3g} in the step to t = {} (greatest condition {}, at t = "
                     "{}): the motion passes a singular position, or nearer to it than the step resolves, and may "
                     "have left it on another branch; take steps that keep this factor below {}",
                     change.of_length ? "the gradient" : "the angle to the other constraints", name(change.constraint),
                     change.factor, to_scientific(change.t, 4), health.condition, to_scientific(angles_.closest_t(), 4),
                     ConstraintAngles<S>::unresolved)});
  else if (2 * std::log2(condition_) > significand_bits<S>() - 1)
    health.warnings.push_back(
        {"near_singular_constraints",
         fmt::format("the condition of the constraints is {} at t = {}: fewer than half of the digits of lambda are "
                     "right; take more digits",
                     health.condition, to_scientific(angles_.closest_t(), 4))});
}

template <Scalar S>
void HealthWatch<S>::report_hidden(Health& health) {
  const auto worst = hidden_.worst();
  health.worst_hidden = to_scientific(worst.cosine, 3);
  if (S(100) * worst.cosine > 1)
    health.warnings.push_back(
        {"hidden_constraint_large",
         fmt::format("the velocity leaves {} by {} of its size at t = {}: the output state is no small correction; "
                     "take a smaller step",
                     name(worst.constraint), health.worst_hidden, to_scientific(worst.t, 4))});
  constexpr long least_steps = 16;
  if (s_ == 0 || s_ % 2 != 0 || steps_ < least_steps) return;
  const auto growth = hidden_.growth(walked_round_off<S>(steps_) * S(condition_));
  if (growth.factor >= 2)
    health.warnings.push_back(
        {"even_s_drift", fmt::format("s = {} is even, and the hidden constraint of {} grew by a factor of {:.3g} "
                                     "from the first quarter of the run to the last; an odd s keeps it bounded",
                                     s_, name(growth.constraint), growth.factor)});
}

template <Scalar S>
void HealthWatch<S>::report_steps(Health& health) {
  const auto worst = decay_.worst(q_);
  if (worst.ratio * decay_.limit() <= 1) return;
  const std::string seen =
      s_ > 1 ? fmt::format("the first neglected coefficient of p is {:.2g} of those that vary (1/{} is the limit)",
                           worst.ratio, decay_.limit())
             : fmt::format("the force changes by {:.2g} of its size within a step (1/{} is the limit)", worst.ratio,
                           decay_.limit());
  health.warnings.push_back({"step_too_large", fmt::format("for q_{}..q_{}: {}; take a smaller step or a larger s",
                                                           worst.offset + 1, worst.offset + problem_.dimension, seen)});
}

template <Scalar S>
Health HealthWatch<S>::report(const Method& method) {
  Health health;
  report_energy(health, method);
  report_drift(health, method);
  report_constraints(health);
  report_hidden(health);
  report_steps(health);
  return health;
}

std::string to_text(const Health& health) {
  std::string text = "what the run is worth\n";
  const auto line = [&](const char* what, const std::string& value) {
    text += fmt::format("  {:<36}{}\n", what, value);
  };
  line("energy error, of H's greatest term", health.worst_e_H);
  line("condition of the Gram matrix", health.condition);
  line("velocity off the tangent space", health.worst_hidden);
  for (const Warning& warning : health.warnings) text += fmt::format("  WARNING {}: {}\n", warning.name, warning.text);
  return text;
}

#define HBVM_DEFINE(S) template class HealthWatch<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm
