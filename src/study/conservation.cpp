#include "study/conservation.hpp"

#include <algorithm>

#include "integrate/momentum_drift.hpp"
#include "run/choose_k.hpp"
#include "run/simulate.hpp"
#include "scalar/text.hpp"
#include "scalar/with_scalar.hpp"

namespace hbvm::core {
namespace {

template <Scalar S>
Conservation conservation_in(const ConservationRequest& request) {
  const TimeGrid<S> grid(request.step, request.until, request.scene->constants);
  const Assembled<S> scene = assemble<S>(*request.scene);
  const Problem<S>& problem = scene.problem;
  Conservation result;
  result.method = {request.s, request.s};
  int r = request.s;
  if (request.nodes == Nodes::more) {
    const ChosenK chosen = choose_k(scene, HbvmName{0, request.s}, grid.step(), SolverKind::automatic);
    result.method.k = chosen.k > request.s ? chosen.k : 2 * request.s;
    r = std::max(r, chosen.r);
  }
  const Hbvm<S> method = make_hbvm<S>(result.method.k, result.method.s, r);
  MomentumDrift<S> momenta(problem, conserved_momenta(problem));
  const Simulated<S> run = simulate(scene, method, SolverKind::automatic, grid, {&momenta});
  result.steps = grid.steps();

  using Kind = ConservedQuantity::Kind;
  const auto add = [&](Kind kind, const std::string& name, const S& drift, const S& size) {
    const double ulps = drift == 0 ? 0 : approximately(S(drift / (size * epsilon<S>())));
    result.quantities.push_back({kind, name, to_text(drift), ulps});
  };
  const Snapshot<S>& end = run.integration.end;
  StateEvaluator<S> point(problem);
  add(Kind::energy, "H", run.e_H, std::max(point.energy_size(scene.q0, scene.p0), point.energy_size(end.q, end.p)));
  if (problem.nu() > 0) add(Kind::constraints, "g", run.e_g, point.constraint_size(end.q));
  for (std::size_t i = 0; i < momenta.components().size(); ++i) {
    const MomentumComponent<S>& component = momenta.components()[i];
    add(component.is_linear() ? Kind::linear_momentum : Kind::angular_momentum, component.name(), momenta.drift(i),
        momenta.size(i));
  }
  return result;
}

}  // namespace

Conservation conservation(const ConservationRequest& request, const Precision& precision) {
  return with_scalar(precision, [&]<Scalar S>() { return conservation_in<S>(request); });
}

}  // namespace hbvm::core
