#pragma once

#include <string>

#include "solver/stage_failure.hpp"

namespace hbvm::core {

/// A step that could not be made. What was computed before it has been shown to the observers.
class StepError : public IntegrationError {
 public:
  StepError(long step, std::string time, const StageFailure& failure);
  /// The same with other advice.
  StepError(const StepError& error, const std::string& advice);
  FailureCause cause() const { return cause_; }
  long step() const { return step_; }
  const std::string& time() const { return time_; }
  const std::string& increment() const { return increment_; }

 private:
  FailureCause cause_;
  long step_;
  std::string time_, increment_;
  std::string seen_;  ///< without the advice
};

}  // namespace hbvm::core
