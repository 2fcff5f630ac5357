#include "run/health.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "problem/regularity.hpp"
#include "run/choose_k.hpp"
#include "scalar/text.hpp"
#include "step/hbvm_method.hpp"

namespace hbvm::core {
namespace {

/// 64 sqrt(n) epsilon: a walk of n steps, each of some tens of roundings. Motions without a loss walk 0.1 to 0.2
/// sqrt(n) epsilon (studies/stability, up to 10^7 steps), and a drift that grows with n passes both soon.
template <Scalar S>
S walked_round_off(long steps) {
  using std::sqrt;
  return S(64) * S(sqrt(S(steps))) * epsilon<S>();
}

bool is_auto(const Method& method) {
  const HbvmMethod* const hbvm = as_hbvm(method);
  return hbvm && hbvm->name().is_auto();
}

}  // namespace

template <Scalar S>
HealthWatch<S>::HealthWatch(const Problem<S>& problem, const Method& method, const TimeGrid<S>& grid)
    : problem_(problem),
      s_(as_hbvm(method) ? as_hbvm(method)->name().s : 0),
      step_(grid.step()),
      h_(magnitude(step_)),
      steps_(grid.steps()),
      rounding_(walked_round_off<S>(steps_)),
      gradient_(problem, 1),
      g_(Matrix<S>::Zero(1, problem.nu())),
      q_(problem.m()),
      v_(problem.m()),
      course_(problem, 1),
      energy_(problem),
      drift_(problem),
      constraints_(problem, rounding_),
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
  place(course_, problem_, snapshot.q);
  course_.set_velocities(lanes(v_));
  gradient_.update(lanes(snapshot.q), g_);
  constraints_.observe(gradient_, g_, snapshot);
  angles_.observe(gradient_, snapshot);
  hidden_.observe(gradient_, v_, snapshot);
}

template <Scalar S>
bool HealthWatch<S>::energy_changed(const typename EnergyChange<S>::Change& change) {
  return change.error > walked_round_off<S>(steps_ + energy_.count()) * energy_.rounding();
}

template <Scalar S>
std::string HealthWatch<S>::lost() {
  std::vector<std::string> found;
  const auto change = energy_.change();
  if (energy_changed(change))
    found.push_back(fmt::format("H had changed by more than 1/{} of the kinetic energy from t = {} on",
                                EnergyChange<S>::part, to_scientific(change.t, 4)));
  const auto& worst = constraints_.worst();
  if (worst.lost)
    found.push_back(fmt::format("{} had drifted by more than 1/{} from t = {} on", name(worst.constraint),
                                ConstraintDrift<S>::part, to_scientific(worst.lost_t, 4)));
  if (found.empty()) return {};
  return fmt::format("{}: what came after is no motion of the scene; take a smaller step", fmt::join(found, ", and "));
}

template <Scalar S>
std::string HealthWatch<S>::lost_before(const S& t) {
  const auto change = energy_.change();
  const auto& worst = constraints_.worst();
  const bool before = (energy_changed(change) && magnitude(change.t) < magnitude(t)) ||
                      (worst.lost && magnitude(worst.lost_t) < magnitude(t));
  return before ? lost() : std::string();
}

template <Scalar S>
void HealthWatch<S>::report_change(Health& health, const Method& method) {
  const auto change = energy_.change();
  if (energy_changed(change))
    health.warnings.push_back(
        {"energy_changed",
         fmt::format(
             "{} is off by {}{}, first by more than 1/{} of it at t = {}: what follows is the motion of another "
             "energy; take a smaller step{}",
             problem_.driven.empty() ? "H" : "H - W", to_scientific(change.error, 3),
             change.usual > 0 ? fmt::format(", {} of the kinetic energy that half of the mesh points do not exceed",
                                            to_scientific(S(change.error / change.usual), 3))
                              : std::string(" and the kinetic energy is 0 at half of the mesh points"),
             EnergyChange<S>::part, to_scientific(change.t, 4),
             method.kept().energy ? "" : ", or a method that conserves H, as hbvm:auto,3")});
  const auto& worst = constraints_.worst();
  const std::string advice = method.kept().constraints
                                 ? "take a smaller step"
                                 : "take a smaller step, or a method that keeps constraints, as hbvm:auto,3 or rattle";
  const S of_general = moved_ * 2 * epsilon<S>();
  if (worst.lost)
    health.warnings.push_back(
        {"constraint_drift",
         fmt::format("{} is off by {} at t = {}, relative as a rod's length is, first by more than 1/{} at t = {}; {}",
                     name(worst.constraint), to_scientific(worst.drift, 3), to_scientific(worst.t, 4),
                     ConstraintDrift<S>::part, to_scientific(worst.lost_t, 4), advice)});
  else if (of_general * ConstraintDrift<S>::part > 1)
    health.warnings.push_back({"constraint_drift", fmt::format("a constraint moved by {} of its terms; {}",
                                                               to_scientific(of_general, 3), advice)});
}

template <Scalar S>
void HealthWatch<S>::report_halving(Health& health, const HalvingLog& log) {
  constexpr int thousandth = 10;
  if (log.substeps <= steps_ - log.steps && log.depth < thousandth) return;
  health.warnings.push_back(
      {"steps_divided",
       fmt::format("{} of {} steps failed and were made of {} parts, down to h/{}, first at t = {}: a part is as long "
                   "as its equations can just be solved, whatever its error; take a smaller step, and see with --error "
                   "what is right",
                   log.steps, steps_, log.substeps, 1L << log.depth, to_scientific(S(step_ * S(log.first_step)), 4))});
}

template <Scalar S>
void HealthWatch<S>::report_energy(Health& health, const Method& asked, const Method& method) {
  const S size = energy_.size(), error = energy_.error();
  const S relative = error == 0 ? S(0) : S(error / size);
  health.worst_e_H = to_scientific(relative, 3);
  const S rounding = energy_.rounding() + h_ * hidden_.power(), walked = walked_round_off<S>(steps_ + energy_.count());
  if (!method.kept().energy || !(error > walked * rounding)) return;
  const HbvmMethod* const hbvm = as_hbvm(method);
  const HbvmName of = hbvm ? hbvm->name() : HbvmName{};
  const int k = of.k, s = of.s;
  const std::optional<int> degree = degree_of_U(problem_);
  const bool exact = !hbvm || (degree && 2 * k >= *degree * s);
  const std::string advice =
      exact ? "the method conserves it exactly: take more digits or a smaller step"
      : is_auto(asked)
          ? fmt::format("it begins with k = {} nodes, and more did not conserve it either: take a smaller step", k)
          : fmt::format("k = {} nodes do not conserve it: take more, or hbvm:auto,{}, or a smaller step", k, s);
  health.warnings.push_back(
      {"energy_lost",
       fmt::format("{} is off by {} of its greatest term at t = {}, more than rounding explains ({}); {}",
                   problem_.driven.empty() ? "H" : "H - W", health.worst_e_H, to_scientific(energy_.t(), 4),
                   to_scientific(S(walked * rounding / size), 1), advice)});
}

template <Scalar S>
void HealthWatch<S>::report_drift(Health& health, const Method& asked, const Method& method) {
  const S limit = rounding_ / epsilon<S>();
  if (!(moved_ > limit) || !method.kept().constraints) return;
  const HbvmMethod* const hbvm = as_hbvm(method);
  const int r = hbvm ? hbvm->constraint_nodes(problem_) : 0;
  const std::string advice =
      !hbvm ? std::string("take a smaller step")
      : is_auto(asked)
          ? fmt::format("it begins with r = {} nodes, and more did not keep it either: take a smaller step", r)
          : fmt::format("r = {} nodes do not keep it: take more, hbvm:{},{},R, or hbvm:auto,{}, or a smaller step", r,
                        hbvm->name().k, s_, s_);
  health.warnings.push_back(
      {"constraints_lost",
       fmt::format("a constraint moved by {} of its terms, more than rounding explains ({}); {}",
                   to_scientific(S(moved_ * epsilon<S>()), 3), to_scientific(S(limit * epsilon<S>()), 1), advice)});
}

template <Scalar S>
void HealthWatch<S>::report_constraints(Health& health) {
  condition_ = problem_.nu() == 0 ? 1 : angle_condition(problem_, angles_.closest_q());
  health.condition = to_scientific(condition_, 3);
  const auto& change = angles_.greatest_change();
  const std::string before_change = lost_before(change.t), before = lost_before(angles_.closest_t());
  if (change.factor >= ConstraintAngles<S>::unresolved)
    health.warnings.push_back(
        {"near_singular_constraints",
         fmt::format("{} of {} changed by a factor of {:.3g} in the step to t = {} (greatest condition {}, at t = "
                     "{}): the motion passes a singular position, or nearer to it than the step resolves, and may "
                     "have left it on another branch; {}",
                     change.of_length ? "the gradient" : "the angle to the other constraints", name(change.constraint),
                     change.factor, to_scientific(change.t, 4), health.condition, to_scientific(angles_.closest_t(), 4),
                     before_change.empty()
                         ? fmt::format("take steps that keep this factor below {}", ConstraintAngles<S>::unresolved)
                         : before_change)});
  else if (2 * std::log2(condition_) > significand_bits<S>() - 1)
    health.warnings.push_back(
        {"near_singular_constraints",
         fmt::format("the condition of the constraints is {} at t = {}: fewer than half of the digits of lambda are "
                     "right; {}",
                     health.condition, to_scientific(angles_.closest_t(), 4),
                     before.empty() ? "take more digits" : before)});
}

template <Scalar S>
void HealthWatch<S>::report_hidden(Health& health) {
  const auto worst = hidden_.worst(h_, rounding_);
  health.worst_hidden = to_scientific(worst.cosine, 3);
  if (S(100) * worst.cosine > 1)
    health.warnings.push_back(
        {"hidden_constraint_large",
         fmt::format("the velocity leaves {} by {} of its size at t = {}: the output state is no small correction; "
                     "take a smaller step",
                     name(worst.constraint), health.worst_hidden, to_scientific(worst.t, 4))});
  constexpr long least_steps = 16;
  if (s_ == 0 || s_ % 2 != 0 || steps_ < least_steps) return;
  const auto growth = hidden_.growth(rounding_ * S(condition_));
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
Health HealthWatch<S>::report(const Method& asked, const Method& method, const HalvingLog* halving) {
  Health health;
  report_change(health, method);
  if (halving) report_halving(health, *halving);
  report_energy(health, asked, method);
  report_drift(health, asked, method);
  report_constraints(health);
  report_hidden(health);
  report_steps(health);
  return health;
}

#define HBVM_DEFINE(S) template class HealthWatch<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
