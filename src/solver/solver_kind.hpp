#pragma once

#include <string_view>

namespace hbvm::core {

/// The solvers by the name a user gives them.
enum class SolverKind {
  automatic,    ///< in double the fixed point, in more digits Newton, and the other where that fails or is slow
  newton,       ///< mixed-precision Newton
  fixed_point,  ///< newest values at once, started from the previous step's polynomial
  paper         ///< (55) to the letter, started from 0
};
/// \throws InputError for an unknown name
SolverKind parse_solver(std::string_view name);
std::string_view name_of(SolverKind kind);

}  // namespace hbvm::core
