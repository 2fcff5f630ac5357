#include "solver/stage_failure.hpp"

namespace hbvm::core {
namespace {

/// By FailureCause.
constexpr struct {
  std::string_view name, remedy;
} causes[] = {
    {"stage_equations_diverge", "try a smaller step"},
    {"near_singular_constraints", "take more digits, or pass the singular position with another step"},
    {"precision_exhausted", "take more digits"},
    {"inconsistent_state", "start from a consistent state: hbvm scene project makes one"},
};

}  // namespace

std::string_view name_of(FailureCause cause) { return causes[static_cast<std::size_t>(cause)].name; }

std::string_view remedy_of(FailureCause cause) { return causes[static_cast<std::size_t>(cause)].remedy; }

}  // namespace hbvm::core
