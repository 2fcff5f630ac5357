#include "run/describe.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "integrate/observations.hpp"
#include "problem/effect/execution.hpp"
#include "problem/effect/trace.hpp"
#include "problem/momenta.hpp"
#include "problem/regularity.hpp"
#include "problem/state_evaluator.hpp"
#include "run/choose_k.hpp"
#include "scalar/literal.hpp"
#include "scalar/text.hpp"
#include "scalar/with_scalar.hpp"
#include "scene/coordinate_names.hpp"
#include "scene/second_moment.hpp"

namespace hbvm::core {
namespace {

/// On whom an effect acts and on whom it does not, and how on rigid bodies.
SceneFacts::Effect whom_it_acts_on(const Scene& scene, const SceneEffect& effect, const EffectReach& reach) {
  SceneFacts::Effect facts;
  facts.kind = effect.kind;
  facts.on = reach.on;
  facts.not_on = left_out(scene, effect, reach);
  std::set<std::string> rigid;
  for (const SceneRigidBody& body : scene.rigid_bodies) rigid.insert(body.name);
  const bool at_centers = std::any_of(reach.on.begin(), reach.on.end(), [&](const std::vector<std::string>& names) {
    return std::any_of(names.begin(), names.end(), [&](const std::string& name) { return rigid.contains(name); });
  });
  if (at_centers && effect.kind != "torque" && effect.kind != "rotating_frame")
    facts.remark = effect.kind == "uniform_gravity" || effect.kind == "spring"
                       ? "rigid bodies at the centre of mass"
                       : "rigid bodies at the centre of mass, the change of the field across them neglected";
  return facts;
}

/// The moments of inertia of a rigid body about its centre of mass, in double.
std::vector<double> inertia_of(const SceneRigidBody& body, const Scene& scene) {
  const auto number = [&](const Expression& e) { return evaluate<double>(e, scene.constants); };
  const Index d = scene.dimension;
  MassDistribution<double> of{number(body.mass), Vector<double>(d), Matrix<double>(d, d)};
  for (Index i = 0; i < d; ++i) {
    const auto row = static_cast<std::size_t>(i);
    of.center[i] = number(body.center[row]);
    for (Index j = 0; j < d; ++j) of.second_moment(i, j) = number(body.second_moment[row][static_cast<std::size_t>(j)]);
  }
  const auto moments = moments_of_inertia(of);
  return {moments.begin(), moments.end()};
}

/// Refuses an effect that has no value at the start, as the attraction of two bodies in one place.
template <Scalar S>
void refuse_singular(const Scene& scene, const Assembled<S>& assembled) {
  for (std::size_t i = 0; i < assembled.reach.size(); ++i) {
    const EffectTerm<S>& term = assembled.problem.potential.terms[i];
    Matrix<S> x(term.instances(), term.arguments * scene.dimension);
    displace(term, scene.dimension, lanes(assembled.q0), x.data(), x.rows());
    Execution<S> U(term.value, term.value_coefficients, x, 1);
    U.run();
    for (Index n = 0; n < term.instances(); ++n)
      if (!is_finite(U.output(0, n)))
        throw InputError(fmt::format("{}:{}: effect {} ({}) has no value at the start on {}", scene.name,
                                     scene.effects[assembled.reach[i].effect].line, assembled.reach[i].effect + 1,
                                     term.kind,
                                     to_text(EffectReach{{assembled.reach[i].on[static_cast<std::size_t>(n)]}})));
  }
}

bool is_force(const SceneEffect& effect) { return !effect.formulas.empty(); }

std::optional<int> degree_or_none(int degree) {
  return degree == Trace<double>::not_polynomial ? std::nullopt : std::optional<int>(degree);
}

/// The momenta along the axes, and those besides that the motion conserves.
template <Scalar S>
std::vector<SceneFacts::Momentum> momenta_of(const Assembled<S>& assembled) {
  const Problem<S>& problem = assembled.problem;
  std::vector<MomentumComponent<S>> components = coordinate_momenta(problem);
  const std::vector<MomentumComponent<S>> conserved = conserved_momenta(problem);
  const auto same_name_in = [](const std::vector<MomentumComponent<S>>& list, const MomentumComponent<S>& component) {
    return std::any_of(list.begin(), list.end(), [&](const auto& c) { return c.name() == component.name(); });
  };
  for (const auto& component : conserved)
    if (!same_name_in(components, component)) components.push_back(component);
  std::vector<SceneFacts::Momentum> momenta;
  for (const auto& component : components)
    momenta.push_back({component.name(), to_text(momentum(problem, component, assembled.q0, assembled.p0).value),
                       same_name_in(conserved, component), component.is_linear()});
  return momenta;
}

template <Scalar S>
SceneFacts describe_in(const Scene& scene) {
  const Assembled<S> assembled = assemble<S>(scene);
  const Problem<S>& problem = assembled.problem;
  refuse_singular(scene, assembled);
  SceneFacts facts;
  facts.name = scene.name;
  facts.title = scene.title;
  facts.source = scene.source;
  facts.dimension = scene.dimension;
  facts.bodies = static_cast<long>(scene.bodies.size());
  for (const SceneRigidBody& body : scene.rigid_bodies)
    facts.rigid_bodies.push_back({body.name, inertia_of(body, scene)});
  facts.attachments = static_cast<long>(scene.attachments.size());
  facts.coordinates = coordinate_names(scene);
  facts.constraints = names_of_constraints(problem);
  for (const RedundantConstraint<S>& redundant : problem.redundant)
    facts.redundant.push_back(static_cast<long>(redundant.place) + 1);
  for (const Redundancy& redundancy : assembled.redundant) facts.redundancies.push_back(to_text(redundancy));
  facts.degrees_of_freedom = static_cast<long>(problem.mass.of_bodies() - problem.nu());
  facts.degree_of_g = degree_or_none(degree_of_g(problem));
  facts.degree_of_U = degree_of_U(problem);
  facts.settled = assembled.settled;
  if (problem.nu() > 0) facts.gram_condition = static_cast<double>(gram_condition(problem, assembled.q0));
  for (std::size_t i = 0; i < problem.potential.terms.size(); ++i) {
    const EffectTerm<S>& term = problem.potential.terms[i];
    if (is_force(scene.effects[assembled.reach[i].effect])) continue;
    SceneFacts::Effect effect = whom_it_acts_on(scene, scene.effects[assembled.reach[i].effect], assembled.reach[i]);
    if (term.degree >= 0) effect.degree = term.degree;
    effect.constant_force = term.constant_force;
    facts.effects.push_back(effect);
  }
  for (const EffectReach& reach : assembled.force_reach) {
    SceneFacts::Effect effect = whom_it_acts_on(scene, scene.effects[reach.effect], reach);
    effect.has_potential = false;
    facts.effects.push_back(effect);
  }
  for (const DrivenPoint<S>& point : problem.driven)
    if (point.name != "t") facts.driven.push_back(point.name);
  StateEvaluator<S> point(problem);
  const S H = point.energy(assembled.q0, assembled.p0);
  const S U = point.energy(assembled.q0, Vector<S>::Zero(problem.m()));
  facts.energy = to_text(H);
  facts.kinetic = to_text(S(H - U));
  facts.potential = to_text(U);
  facts.momenta = momenta_of(assembled);
  if (!scene.observations.empty()) {
    Observations<S> observations(scene, problem);
    const Vector<S>& values = observations.see(S(0), assembled.q0, assembled.p0);
    for (std::size_t i = 0; i < scene.observations.size(); ++i)
      facts.observed.push_back(
          {scene.observations[i].name, scene.observations[i].value.text(), to_text(values[static_cast<Index>(i)])});
  }
  return facts;
}

}  // namespace

SceneFacts describe(const Scene& scene, const Precision& precision) {
  return with_scalar(precision, [&]<Scalar S>() { return describe_in<S>(scene); });
}

}  // namespace hbvm::core
