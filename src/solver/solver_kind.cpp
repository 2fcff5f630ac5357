#include "solver/solver_kind.hpp"

#include <array>
#include <string>
#include <utility>

#include "hbvm/error.hpp"

namespace hbvm::core {
namespace {

constexpr std::array<std::pair<SolverKind, std::string_view>, 4> solvers{{{SolverKind::automatic, "auto"},
                                                                          {SolverKind::newton, "newton"},
                                                                          {SolverKind::fixed_point, "fixed-point"},
                                                                          {SolverKind::paper, "paper"}}};

}  // namespace

SolverKind parse_solver(std::string_view name) {
  for (const auto& [kind, own_name] : solvers)
    if (name == own_name) return kind;
  throw InputError("unknown solver '" + std::string(name) + "': use auto, newton, fixed-point or paper");
}

std::string_view name_of(SolverKind kind) {
  for (const auto& [own_kind, name] : solvers)
    if (kind == own_kind) return name;
  return {};
}

}  // namespace hbvm::core
