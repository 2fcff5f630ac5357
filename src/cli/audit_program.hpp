#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hbvm/solver.hpp"

namespace hbvm::core {

struct ProgramArguments {
  std::string command;  ///< with {scene}, {step}, {until} and {out}
  std::vector<std::string> scenes, map;
  std::optional<int> order;
  std::optional<std::string> until;
  double limit = 0;  ///< seconds of one run; 0: any
};

/// Judges a program that integrates scenes, by its runs. \throws InputError, Interrupted
SolverAudit audit_program(const ProgramArguments& arguments);

}  // namespace hbvm::core
