#include "integrate/between_steps.hpp"

#include "integrate/output_state.hpp"
#include "scalar/text.hpp"
#include "solver/stage_failure.hpp"

namespace hbvm::core {

template <Scalar S>
BetweenSteps<S>::BetweenSteps(std::unique_ptr<Stepper<S>> stepper)
    : stepper_(std::move(stepper)), back_(*stepper_), point_(stepper_->problem()) {}

template <Scalar S>
StateBetween<S> BetweenSteps<S>::at(const Snapshot<S>& mesh, const S& t) {
  const OutputState<S> output = output_state(point_, mesh.q, mesh.p);
  const S ahead = t - mesh.t;
  if (ahead == 0) return {t, mesh.q, output.p, output.lambda};
  State<S> state(mesh.q, output.p);
  try {
    if (ahead > 0)
      stepper_->step(state, ahead);
    else
      back_.step(state, S(-ahead));
  } catch (const StageFailure& failure) {
    throw IntegrationError("from the mesh point t = " + to_text(mesh.t) + " to t = " + to_text(t) + ": " +
                           failure.what());
  }
  const OutputState<S> end = output_state(point_, state.q, state.p);
  return {t, state.q, end.p, end.lambda};
}

#define HBVM_DEFINE(S) template class BetweenSteps<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
