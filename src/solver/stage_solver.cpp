#include "hbvm/solver/stage_solver.hpp"

#include "hbvm/solver/fixed_point.hpp"

namespace hbvm {

SolverKind parse_solver(std::string_view name) {
  for (const SolverKind kind : {SolverKind::fixed_point, SolverKind::paper})
    if (name == name_of(kind)) return kind;
  throw InputError("unknown solver '" + std::string(name) + "': use fixed-point or paper");
}

std::string_view name_of(SolverKind kind) { return kind == SolverKind::paper ? "paper" : "fixed-point"; }

template <Scalar S>
std::unique_ptr<StageSolver<S>> make_solver(SolverKind kind, const Problem<S>& problem, const Hbvm<S>& method,
                                            const S& step) {
  using Order = typename FixedPoint<S>::Order;
  return std::make_unique<FixedPoint<S>>(problem, method, step,
                                         kind == SolverKind::paper ? Order::paper : Order::newest);
}

#define HBVM_DEFINE(S) \
  template std::unique_ptr<StageSolver<S>> make_solver<S>(SolverKind, const Problem<S>&, const Hbvm<S>&, const S&);
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm
