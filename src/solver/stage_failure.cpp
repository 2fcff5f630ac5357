#include "solver/stage_failure.hpp"

namespace hbvm::core {

std::string_view name_of(FailureCause cause) {
  switch (cause) {
    case FailureCause::stage_equations_diverge:
      return "stage_equations_diverge";
    case FailureCause::near_singular_constraints:
      return "near_singular_constraints";
    case FailureCause::precision_exhausted:
      return "precision_exhausted";
    case FailureCause::inconsistent_state:
      break;
  }
  return "inconsistent_state";
}

std::string_view remedy_of(FailureCause cause) {
  switch (cause) {
    case FailureCause::stage_equations_diverge:
      return "try a smaller step";
    case FailureCause::near_singular_constraints:
      return "take more digits, or pass the singular position with another step";
    case FailureCause::precision_exhausted:
      return "take more digits";
    case FailureCause::inconsistent_state:
      break;
  }
  return "start from a consistent state: hbvm scene project makes one";
}

}  // namespace hbvm::core
