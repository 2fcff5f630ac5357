#include "integrate/between_steps.hpp"

#include "integrate/output_state.hpp"
#include "scalar/text.hpp"
#include "solver/stage_failure.hpp"

namespace hbvm::core {

template <Scalar S>
BetweenSteps<S>::BetweenSteps(std::unique_ptr<Stepper<S>> stepper)
    : stepper_(std::move(stepper)), back_(*stepper_), point_(stepper_->problem()) {}

template <Scalar S>
StateBetween<S> BetweenSteps<S>::output(const Snapshot<S>& mesh) {
  OutputState<S> found = output_state(point_, mesh.q, mesh.p);
  return {mesh.t, mesh.q, std::move(found.p), std::move(found.lambda)};
}

template <Scalar S>
StateBetween<S> BetweenSteps<S>::from(const StateBetween<S>& output, const S& t) {
  const S ahead = t - output.t;
  if (ahead == 0) return output;
  State<S> state(output.q, output.p);
  try {
    if (ahead > 0)
      stepper_->step(state, ahead);
    else
      back_.step(state, S(-ahead));
  } catch (const StageFailure& failure) {
    throw IntegrationError("from the mesh point t = " + to_text(output.t) + " to t = " + to_text(t) + ": " +
                           failure.what());
  }
  OutputState<S> end = output_state(point_, state.q, state.p);
  return {t, std::move(state.q), std::move(end.p), std::move(end.lambda)};
}

#define HBVM_DEFINE(S) template class BetweenSteps<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
