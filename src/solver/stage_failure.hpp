#pragma once

#include <string>
#include <string_view>

#include "hbvm/error.hpp"

namespace hbvm::core {

/// Why a step could not be made. Messages, JSON and the collection of hard cases call it by name_of.
enum class FailureCause {
  stage_equations_diverge,    ///< no solution of the stage equations was reached
  near_singular_constraints,  ///< the constraints' gradients are (nearly) linearly dependent
  precision_exhausted,        ///< what is left of the digits does not decide the step
  inconsistent_state          ///< the state does not fulfil the constraints it should
};
std::string_view name_of(FailureCause cause);
/// What a user can do about it.
std::string_view remedy_of(FailureCause cause);

/// A step that could not be made. `increment` is the last change of the unknowns over their size; what() says what was
/// seen, with the estimate that decided.
class StageFailure : public Error {
 public:
  StageFailure(FailureCause cause, const std::string& what, std::string increment, long sweeps)
      : Error(what), cause_(cause), increment_(std::move(increment)), sweeps_(sweeps) {}
  FailureCause cause() const { return cause_; }
  const std::string& increment() const { return increment_; }
  long sweeps() const { return sweeps_; }

 private:
  FailureCause cause_;
  std::string increment_;
  long sweeps_;
};

}  // namespace hbvm::core
