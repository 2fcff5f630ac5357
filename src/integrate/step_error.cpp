#include "hbvm/integrate/step_error.hpp"

namespace hbvm {

StepError::StepError(long step, std::string time, const StageFailure& failure)
    : IntegrationError("step " + std::to_string(step) + " from t = " + time + ": " +
                       std::string(name_of(failure.cause())) + ": " + failure.what() + " after " +
                       std::to_string(failure.sweeps()) + " sweeps, last increment " + failure.increment() +
                       " of the unknowns; " + std::string(remedy_of(failure.cause()))),
      cause_(failure.cause()),
      step_(step),
      time_(std::move(time)),
      increment_(failure.increment()) {}

}  // namespace hbvm
