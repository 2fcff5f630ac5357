#include "run/describe.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

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

/// Lines on whom an effect acts and on whom it does not, and how on rigid bodies.
std::vector<std::pair<std::string, std::string>> whom_it_acts_on(const Scene& scene, const SceneEffect& effect,
                                                                 const EffectReach& reach) {
  std::vector<std::pair<std::string, std::string>> lines{{"  on", to_text(reach)}};
  std::set<std::string> rigid;
  for (const SceneRigidBody& body : scene.rigid_bodies) rigid.insert(body.name);
  const bool at_centers = std::any_of(reach.on.begin(), reach.on.end(), [&](const std::vector<std::string>& names) {
    return std::any_of(names.begin(), names.end(), [&](const std::string& name) { return rigid.contains(name); });
  });
  if (at_centers)
    lines.emplace_back("", effect.kind == "uniform_gravity" || effect.kind == "spring"
                               ? "rigid bodies at the centre of mass"
                               : "rigid bodies at the centre of mass, the change of the field across them neglected");
  constexpr std::size_t most = 20;
  const auto without = left_out(scene, effect, reach);
  std::string text;
  for (std::size_t i = 0; i < std::min(most, without.size()); ++i)
    text += fmt::format("{}'{}' ({})", i > 0 ? ", " : "", without[i].first, without[i].second);
  if (without.size() > most) text += fmt::format(", and {} more", without.size() - most);
  if (!text.empty()) lines.emplace_back("  not on", text);
  return lines;
}

/// The moments of inertia of a rigid body, in double.
std::string inertia_of(const SceneRigidBody& body, const Scene& scene) {
  const auto number = [&](const Expression& e) { return evaluate<double>(e, scene.constants); };
  const Index d = scene.dimension;
  MassDistribution<double> of{number(body.mass), Vector<double>(d), Matrix<double>(d, d)};
  for (Index i = 0; i < d; ++i) {
    const auto row = static_cast<std::size_t>(i);
    of.center[i] = number(body.center[row]);
    for (Index j = 0; j < d; ++j) of.second_moment(i, j) = number(body.second_moment[row][static_cast<std::size_t>(j)]);
  }
  std::string text;
  for (const double moment : moments_of_inertia(of)) text += fmt::format("{}{:.6g}", text.empty() ? "" : ", ", moment);
  return text + " about the centre of mass";
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
                                     scene.effects[i].line, i + 1, term.kind,
                                     to_text(EffectReach{{assembled.reach[i].on[static_cast<std::size_t>(n)]}})));
  }
}

template <Scalar S>
std::string describe_in(const Scene& scene) {
  const Assembled<S> assembled = assemble<S>(scene);
  const Problem<S>& problem = assembled.problem;
  refuse_singular(scene, assembled);
  const auto& q = assembled.q0;
  const auto& p = assembled.p0;
  std::string text = fmt::format("{}: {}\n", scene.name, scene.title);
  const auto line = [&](const std::string& what, const std::string& value) {
    text += fmt::format("  {:<22}{}\n", what, value);
  };
  if (!scene.source.empty()) line("source", scene.source);
  line("space", fmt::format("{} dimensions", scene.dimension));
  line("bodies", fmt::format("{}, and {} rigid", scene.bodies.size(), scene.rigid_bodies.size()));
  for (const SceneRigidBody& body : scene.rigid_bodies)
    line("  '" + body.name + "'", "inertia " + inertia_of(body, scene));
  if (!scene.attachments.empty()) line("attachments", std::to_string(scene.attachments.size()));
  line("coordinates m", std::to_string(problem.m()));
  const std::vector<std::string> names = coordinate_names(scene);
  const auto d = static_cast<std::size_t>(scene.dimension);
  for (std::size_t i = 0; i < names.size(); i += d) {
    std::string of_one_point;
    for (std::size_t j = i; j < std::min(i + d, names.size()); ++j)
      of_one_point += fmt::format("{}q_{} = {}", j > i ? ", " : "", j + 1, names[j]);
    line("", of_one_point);
  }
  line("constraints nu", std::to_string(problem.nu()));
  line("degrees of freedom", std::to_string(problem.m() - problem.nu()));
  Index listed = 0;
  for (Index place = 0; listed < problem.nu(); ++place) {
    const auto here = [&](const RedundantConstraint<S>& redundant) { return redundant.place == place; };
    if (std::none_of(problem.redundant.begin(), problem.redundant.end(), here))
      line(fmt::format("  g_{}", place + 1), problem.constraints[static_cast<std::size_t>(listed++)].name);
  }
  const int of_g = degree(problem.constraints);
  if (of_g == Trace<S>::not_polynomial)
    line("g", "not a polynomial: kept to O(h^(2r)) by hbvm:K,S,R; hbvm:auto,S takes the r that reaches round-off");
  else if (of_g > 2)
    line("g", fmt::format("polynomial of degree {}: r >= {}/2 s nodes keep it exactly", of_g, of_g));
  for (const Redundancy& redundancy : assembled.redundant) line("  redundant", to_text(redundancy));
  if (!assembled.settled.empty()) line("start", assembled.settled);
  if (problem.nu() > 0) line("Gram matrix", fmt::format("condition {:.3g} at the start", gram_condition(problem, q)));
  if (problem.potential.terms.empty()) line("effects", "none");
  for (std::size_t i = 0; i < problem.potential.terms.size(); ++i) {
    const EffectTerm<S>& term = problem.potential.terms[i];
    const std::string degree = term.degree < 0 ? "not a polynomial" : fmt::format("degree {}", term.degree);
    line("effect", fmt::format("{}, {} in all, {}{}", term.kind, term.instances(), degree,
                               term.constant_force ? ", constant force: evaluated once" : ""));
    for (const auto& [what, whom] : whom_it_acts_on(scene, scene.effects[i], assembled.reach[i])) line(what, whom);
  }
  if (const auto degree = degree_of_U(problem))
    line("U", *degree <= 2
                  ? fmt::format("polynomial of degree {}: k = s conserves energy exactly", *degree)
                  : fmt::format("polynomial of degree {}: k >= {}/2 s conserves energy exactly", *degree, *degree));
  else
    line("U", "not a polynomial: energy is conserved to O(h^(2k)); hbvm:auto,S takes the k that reaches round-off");
  StateEvaluator<S> point(problem);
  const S H = point.energy(q, p), U = point.energy(q, Vector<S>::Zero(problem.m()));
  line("energy H", to_text(H));
  line("  kinetic, potential", to_text(S(H - U)) + ", " + to_text(U));
  std::vector<MomentumComponent<S>> components = coordinate_momenta(problem);
  const std::vector<MomentumComponent<S>> conserved = conserved_momenta(problem);
  const auto same_name_in = [](const std::vector<MomentumComponent<S>>& list, const MomentumComponent<S>& component) {
    return std::any_of(list.begin(), list.end(), [&](const auto& c) { return c.name() == component.name(); });
  };
  for (const auto& component : conserved)
    if (!same_name_in(components, component)) components.push_back(component);
  for (const auto& component : components) {
    const bool kept = same_name_in(conserved, component);
    line(component.name(), to_text(momentum(problem, component, q, p).value) +
                               (!kept                   ? ""
                                : component.is_linear() ? "  conserved"
                                : of_g == 2             ? "  conserved by the motion, and by k = s"
                                                        : "  conserved by the motion, and by k = r = s"));
  }
  return text;
}

}  // namespace

std::string describe(const Scene& scene, const Precision& precision) {
  return with_scalar(precision, [&]<Scalar S>() { return describe_in<S>(scene); });
}

}  // namespace hbvm::core
