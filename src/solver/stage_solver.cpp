#include "solver/stage_solver.hpp"

#include "solver/automatic.hpp"
#include "solver/fixed_point.hpp"
#include "solver/newton.hpp"

namespace hbvm::core {

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

}  // namespace hbvm::core
