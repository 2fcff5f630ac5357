#include "hbvm/solver/stage_solver.hpp"

#include <array>

#include "hbvm/solver/automatic.hpp"
#include "hbvm/solver/fixed_point.hpp"
#include "hbvm/solver/newton.hpp"

namespace hbvm {

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

template <Scalar S>
std::unique_ptr<StageSolver<S>> make_solver(SolverKind kind, const Problem<S>& problem, const Hbvm<S>& method) {
  using Order = typename FixedPoint<S>::Order;
  switch (kind) {
    case SolverKind::automatic:
      return std::make_unique<Automatic<S>>(problem, method);
    case SolverKind::newton:
      return std::make_unique<Newton<S>>(problem, method);
    case SolverKind::fixed_point:
      return std::make_unique<FixedPoint<S>>(problem, method, Order::newest);
    case SolverKind::paper:
      break;
  }
  return std::make_unique<FixedPoint<S>>(problem, method, Order::paper);
}

#define HBVM_DEFINE(S) \
  template std::unique_ptr<StageSolver<S>> make_solver<S>(SolverKind, const Problem<S>&, const Hbvm<S>&);
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm
