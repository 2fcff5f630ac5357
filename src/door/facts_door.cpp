#include <fmt/format.h>

#include <algorithm>

#include "door/door.hpp"
#include "hbvm/scene.hpp"
#include "long_work/json.hpp"
#include "run/describe.hpp"
#include "scene/effect_reach.hpp"

namespace hbvm {
namespace {

std::string moments(const std::vector<double>& inertia) {
  std::string text;
  for (const double moment : inertia) text += fmt::format("{}{:.6g}", text.empty() ? "" : ", ", moment);
  return text;
}

/// "'a' (not named), 'b' (no charge), and 3 more".
std::string left_out_text(const std::vector<std::pair<std::string, std::string>>& bodies) {
  constexpr std::size_t most = 20;
  std::string text;
  for (std::size_t i = 0; i < std::min(most, bodies.size()); ++i)
    text += fmt::format("{}'{}' ({})", i > 0 ? ", " : "", bodies[i].first, bodies[i].second);
  if (bodies.size() > most) text += fmt::format(", and {} more", bodies.size() - most);
  return text;
}

/// Lines "  what                  value".
class FactLines {
 public:
  explicit FactLines(const std::string& head) : text_(head + "\n") {}
  void add(const std::string& what, const std::string& value) { text_ += fmt::format("  {:<22}{}\n", what, value); }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

/// The coordinates, a point's on a line: "q_1 = a.x, q_2 = a.y".
void add_coordinates(FactLines& lines, const SceneFacts& facts) {
  lines.add("coordinates m", std::to_string(facts.coordinates.size()));
  const auto d = static_cast<std::size_t>(facts.dimension);
  for (std::size_t i = 0; i < facts.coordinates.size(); i += d) {
    std::string of_one_point;
    for (std::size_t j = i; j < std::min(i + d, facts.coordinates.size()); ++j)
      of_one_point += fmt::format("{}q_{} = {}", j > i ? ", " : "", j + 1, facts.coordinates[j]);
    lines.add("", of_one_point);
  }
}

void add_constraints(FactLines& lines, const SceneFacts& facts) {
  lines.add("constraints nu", std::to_string(facts.constraints.size() - facts.redundant.size()));
  lines.add("degrees of freedom", std::to_string(facts.degrees_of_freedom));
  for (std::size_t i = 0; i < facts.constraints.size(); ++i) {
    const long number = static_cast<long>(i) + 1;
    if (std::find(facts.redundant.begin(), facts.redundant.end(), number) == facts.redundant.end())
      lines.add(fmt::format("  g_{}", number), facts.constraints[i]);
  }
  if (!facts.degree_of_g)
    lines.add("g", "not a polynomial: kept to O(h^(2r)) by hbvm:K,S,R; hbvm:auto,S takes the r that reaches round-off");
  else if (*facts.degree_of_g > 2)
    lines.add("g", fmt::format("polynomial of degree {0}: r >= {0}/2 s nodes keep it exactly", *facts.degree_of_g));
  for (const std::string& redundancy : facts.redundancies) lines.add("  redundant", redundancy);
  if (!facts.settled.empty()) lines.add("start", facts.settled);
  if (facts.gram_condition)
    lines.add("Gram matrix", fmt::format("condition {:.3g} at the start", *facts.gram_condition));
}

void add_effects(FactLines& lines, const SceneFacts& facts) {
  if (facts.effects.empty()) lines.add("effects", "none");
  for (const SceneFacts::Effect& effect : facts.effects) {
    const std::string degree = effect.degree ? fmt::format("degree {}", *effect.degree) : "not a polynomial";
    lines.add("effect", fmt::format("{}, {} in all, {}{}", effect.kind, effect.on.size(),
                                    effect.has_potential ? degree : std::string("a force without a potential"),
                                    effect.constant_force ? ", constant force: evaluated once" : ""));
    lines.add("  on", to_text(core::EffectReach{effect.on}));
    if (!effect.remark.empty()) lines.add("", effect.remark);
    if (!effect.not_on.empty()) lines.add("  not on", left_out_text(effect.not_on));
  }
  for (const std::string& account : facts.driven) lines.add("work of", account);
  if (!facts.degree_of_U)
    lines.add("U",
              "not a polynomial: energy is conserved to O(h^(2k)); hbvm:auto,S takes the k that reaches round-off");
  else
    lines.add("U", fmt::format("polynomial of degree {}: {} conserves energy exactly", *facts.degree_of_U,
                               *facts.degree_of_U <= 2 ? "k = s" : fmt::format("k >= {}/2 s", *facts.degree_of_U)));
}

core::OrderedJson number_or_null(const std::optional<int>& number) {
  return number ? core::OrderedJson(*number) : core::OrderedJson(nullptr);
}

core::OrderedJson json_of(const SceneFacts::Effect& effect) {
  core::OrderedJson not_on = core::OrderedJson::object();
  for (const auto& [body, why] : effect.not_on) not_on[body] = why;
  return {{"kind", effect.kind},
          {"degree", number_or_null(effect.degree)},
          {"has_potential", effect.has_potential},
          {"constant_force", effect.constant_force},
          {"on", effect.on},
          {"not_on", not_on}};
}

}  // namespace

SceneFacts describe(const Scene& scene, const std::string& precision) {
  return core::describe(core::scene_of(scene), core::Precision::parse(precision));
}

std::string to_text(const SceneFacts& facts) {
  FactLines lines(facts.name + ": " + facts.title);
  if (!facts.source.empty()) lines.add("source", facts.source);
  lines.add("space", fmt::format("{} dimensions", facts.dimension));
  lines.add("bodies", fmt::format("{}, and {} rigid", facts.bodies, facts.rigid_bodies.size()));
  for (const SceneFacts::Rigid& body : facts.rigid_bodies)
    lines.add("  '" + body.name + "'", "inertia " + moments(body.inertia) + " about the centre of mass");
  if (facts.attachments > 0) lines.add("attachments", std::to_string(facts.attachments));
  add_coordinates(lines, facts);
  add_constraints(lines, facts);
  add_effects(lines, facts);
  lines.add("energy H", facts.energy);
  lines.add("  kinetic, potential", facts.kinetic + ", " + facts.potential);
  const bool quadratic = facts.degree_of_g && *facts.degree_of_g == 2;
  for (const SceneFacts::Momentum& momentum : facts.momenta)
    lines.add(momentum.name, momentum.value + (!momentum.conserved ? ""
                                               : momentum.linear   ? "  conserved"
                                               : quadratic         ? "  conserved by the motion, and by k = s"
                                                                   : "  conserved by the motion, and by k = r = s"));
  for (const Observation& o : facts.observed)
    lines.add("observed", o.name + " = " + o.value + (o.name == o.formula ? "" : ", " + o.formula));
  return lines.text();
}

std::string to_json(const SceneFacts& facts) {
  core::OrderedJson rigid = core::OrderedJson::object(), effects = core::OrderedJson::array();
  for (const SceneFacts::Rigid& body : facts.rigid_bodies) rigid[body.name] = {{"inertia", body.inertia}};
  for (const SceneFacts::Effect& effect : facts.effects) effects.push_back(json_of(effect));
  core::OrderedJson momenta = core::OrderedJson::object();
  for (const SceneFacts::Momentum& momentum : facts.momenta)
    momenta[momentum.name] = {{"value", momentum.value}, {"conserved", momentum.conserved}};
  core::OrderedJson json{{"scene", facts.name},
                         {"title", facts.title},
                         {"source", facts.source},
                         {"dimension", facts.dimension},
                         {"bodies", facts.bodies},
                         {"rigid_bodies", rigid},
                         {"attachments", facts.attachments},
                         {"coordinates", facts.coordinates},
                         {"constraints", facts.constraints},
                         {"redundant", facts.redundant},
                         {"degrees_of_freedom", facts.degrees_of_freedom},
                         {"degree_of_g", number_or_null(facts.degree_of_g)},
                         {"degree_of_U", number_or_null(facts.degree_of_U)}};
  json["gram_condition"] = facts.gram_condition ? core::json_number(*facts.gram_condition) : core::OrderedJson(nullptr);
  if (!facts.settled.empty()) json["start_settled"] = facts.settled;
  json["effects"] = effects;
  json["energy"] = facts.energy;
  json["kinetic"] = facts.kinetic;
  json["potential"] = facts.potential;
  json["momenta"] = momenta;
  for (const Observation& o : facts.observed) json["observed"][o.name] = {{"formula", o.formula}, {"value", o.value}};
  return core::dumped(json, 2);
}

}  // namespace hbvm
