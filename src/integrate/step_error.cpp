#include "integrate/step_error.hpp"

namespace hbvm::core {
namespace {

std::string seen(long step, const std::string& time, const StageFailure& failure) {
  return "step " + std::to_string(step) + " from t = " + time + ": " + std::string(name_of(failure.cause())) + ": " +
         failure.what() + " after " + std::to_string(failure.sweeps()) + " sweeps, last increment " +
         failure.increment() + " of the unknowns";
}

}  // namespace

StepError::StepError(long step, std::string time, const StageFailure& failure)
    : IntegrationError(seen(step, time, failure) + "; " + std::string(remedy_of(failure.cause()))),
      cause_(failure.cause()),
      step_(step),
      time_(std::move(time)),
      increment_(failure.increment()),
      seen_(seen(step_, time_, failure)) {}

StepError::StepError(const StepError& error, const std::string& advice)
    : IntegrationError(error.seen_ + "; " + advice),
      cause_(error.cause_),
      step_(error.step_),
      time_(error.time_),
      increment_(error.increment_),
      seen_(error.seen_) {}

}  // namespace hbvm::core
