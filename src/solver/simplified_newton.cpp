#include "solver/simplified_newton.hpp"

#include "scalar/in_place.hpp"
#include "solver/step_growth.hpp"

namespace hbvm::core {
namespace {

/// Where the solution is followed from, as -log2 of the part of the step.
constexpr int short_step = 12, shortest_step = 30;

}  // namespace

template <Scalar S>
SimplifiedNewton<S>::SimplifiedNewton(const Problem<S>& problem, const Hbvm<S>& method, Wanted wanted)
    : iteration_(problem, method, wanted), starts_(problem, method, iteration_.unknowns()), guard_(problem, method) {}

template <Scalar S>
long SimplifiedNewton<S>::solve(const StepStart<S>& from) {
  if (from.h != h_) {
    set(h_, from.h);
    starts_.clear();
    iteration_.forget_jacobian();
  }
  iteration_.begin(from, h_);
  long sweeps = 0;
  const auto leads = [&](Start start) { return leads_to_solution(start, from, sweeps); };
  if (!starts_.known() || !leads(Start::previous))
    if (!leads(Start::constant) && !leads(Start::shorter)) leads(Start::shortest);
  starts_.keep(iteration_.unknowns());
  return sweeps;
}

template <Scalar S>
bool SimplifiedNewton<S>::leads_to_solution(Start start, const StepStart<S>& from, long& sweeps) {
  StageUnknowns<S>& x = iteration_.unknowns();
  const bool grown = start == Start::shorter || start == Start::shortest;
  try {
    if (grown) {
      sweeps += grow(iteration_, guard_, from, start == Start::shorter ? short_step : shortest_step);
      iteration_.forget_jacobian();
    } else if (start == Start::previous) {
      starts_.predict(x);
    } else {
      NewtonStarts<S>::set_constant(iteration_.equations(), x);
    }
    sweeps += iteration_.run();
    if (grown) return true;
    guard_.start(iteration_.equations(), iteration_.start());
    return !guard_.is_far(x) && !guard_.multipliers_run_wild(x);
  } catch (const StageFailure& failure) {
    sweeps += failure.sweeps();
    iteration_.forget_jacobian();
    if (start == Start::shortest) throw StageFailure(failure.cause(), failure.what(), failure.increment(), sweeps);
    return false;
  }
}

template <Scalar S>
long SimplifiedNewton<S>::follow(const StepStart<S>& from) {
  set(h_, from.h);
  iteration_.forget_jacobian();
  long sweeps = 0;
  for (const int halvings : {short_step, shortest_step}) {
    try {
      sweeps += grow(iteration_, guard_, from, halvings);
      break;
    } catch (const StageFailure& failure) {
      sweeps += failure.sweeps();
      if (halvings == shortest_step) throw StageFailure(failure.cause(), failure.what(), failure.increment(), sweeps);
    }
  }
  return sweeps;
}

template <Scalar S>
void SimplifiedNewton<S>::adopt(const StepStart<S>& from, const StageUnknowns<S>& solution) {
  iteration_.begin(from, from.h);
  set(iteration_.unknowns(), solution);
}

template <Scalar S>
SolverCounts SimplifiedNewton<S>::counts() const {
  SolverCounts all{equations().effect_counts(), equations().part_counts()};
  const auto add = [&](const std::vector<PartCount>& parts) {
    all.parts.insert(all.parts.end(), parts.begin(), parts.end());
  };
  add(jacobian().part_counts());
  add(starts_.part_counts());
  add({iteration_.increment_count()});
  return all;
}

template <Scalar S>
std::vector<PartCount> SimplifiedNewton<S>::counts_in_double() const {
  std::vector<PartCount> parts{iteration_.equations_count()};
  const auto add = [&](const std::vector<PartCount>& more) { parts.insert(parts.end(), more.begin(), more.end()); };
  add(jacobian().part_counts());
  add(starts_.part_counts());
  add({iteration_.increment_count()});
  for (PartCount& part : parts) part.in_double = true;
  return parts;
}

#define HBVM_DEFINE(S) template class SimplifiedNewton<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
