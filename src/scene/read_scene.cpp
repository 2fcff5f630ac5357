#include <algorithm>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>

#include "hbvm/problem/constraint/registry.hpp"
#include "hbvm/problem/effect/registry.hpp"
#include "hbvm/scene/scene.hpp"
#include "toml/toml_table.hpp"

namespace hbvm {
namespace {

class SceneReader {
 public:
  SceneReader(const TomlSource& source, Scene& scene) : source_(source), scene_(scene) {}

  void read(const toml::table& root) {
    TomlTable top(source_, root, "scene");
    top.expect({"title", "source", "dimension", "observables", "constants", "point", "body", "rigid_body", "constraint",
                "effect"});
    scene_.title = top.optional_string("title");
    scene_.source = top.optional_string("source");
    const long dimension = top.integer("dimension");
    if (dimension != 2 && dimension != 3) top.fail(top.require("dimension"), "'dimension' must be 2 or 3");
    scene_.dimension = static_cast<int>(dimension);
    d_ = static_cast<std::size_t>(dimension);
    if (const toml::node* const node = top.take("constants")) constants(*node, top);
    for (const toml::table* table : top.tables("point")) point(TomlTable(source_, *table, "point"));
    for (const toml::table* table : top.tables("body")) body(TomlTable(source_, *table, "body"));
    for (const toml::table* table : top.tables("rigid_body")) rigid_body(TomlTable(source_, *table, "rigid_body"));
    for (const toml::table* table : top.tables("constraint")) constraint(TomlTable(source_, *table, "constraint"));
    for (const toml::table* table : top.tables("effect")) effect(TomlTable(source_, *table, "effect"));
    if (const toml::node* const node = top.take("observables")) {
      scene_.observables = top.strings("observables");
      const std::vector<std::string> known{"energy", "linear_momentum", "angular_momentum"};
      for (const std::string& name : scene_.observables)
        if (std::count(known.begin(), known.end(), name) == 0) {
          const std::string guess = nearest(name, known);
          top.fail(*node,
                   "unknown observable '" + name + "'" + (guess.empty() ? "" : ": did you mean '" + guess + "'?"));
        }
    }
    if (scene_.bodies.empty() && scene_.rigid_bodies.empty()) top.fail("there is no [[body]]");
  }

 private:
  void constants(const toml::node& node, const TomlTable& top) {
    const toml::table* const table = node.as_table();
    if (!table) top.fail(node, "'constants' must be a table");
    TomlTable reader(source_, *table, "constants");
    for (const auto& [key, value] : *table) {
      const std::string name(key.str());
      bool valid = !name.empty() && !(name[0] >= '0' && name[0] <= '9');
      for (const char c : name)
        valid = valid && ((c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_');
      for (const char* reserved : {"pi", "sqrt", "sin", "cos", "exp", "log"}) valid = valid && name != reserved;
      if (!valid) reader.fail(value, "'" + name + "' cannot be the name of a constant");
      scene_.constants.emplace(name, reader.to_number(value, "'" + name + "'"));
    }
  }

  std::string new_name(TomlTable& table, const std::string& kind) {
    std::string name = table.string("name");
    table.rename(kind + " '" + name + "'");
    if (!names_.insert(name).second) table.fail("there is another body or point of this name");
    return name;
  }

  void point(TomlTable table) {
    ScenePoint p;
    p.name = new_name(table, "point");
    p.line = table.line();
    p.position = table.vector("position", d_);
    p.charge = table.optional_number("charge");
    table.finish();
    points_.insert(p.name);
    scene_.points.push_back(std::move(p));
  }

  void body(TomlTable table) {
    SceneBody b;
    b.name = new_name(table, "body");
    b.line = table.line();
    if (table.is_array("mass"))
      b.mass_matrix = table.matrix("mass", d_);
    else
      b.mass = table.number("mass");
    b.position = table.vector("position", d_);
    if (table.has("velocity") == table.has("momentum")) {
      table.take("charge");
      if (!table.has("velocity")) table.missing({"velocity", "momentum"});
      table.fail("give either 'velocity' or 'momentum'");
    }
    (table.has("velocity") ? b.velocity : b.momentum) =
        table.vector(table.has("velocity") ? "velocity" : "momentum", d_);
    b.charge = table.optional_number("charge");
    table.finish();
    bodies_.insert(b.name);
    scene_.bodies.push_back(std::move(b));
  }

  void rigid_body(TomlTable table) {
    if (scene_.dimension != 3) table.fail("a rigid body needs dimension = 3");
    const std::string name = new_name(table, "rigid_body");
    const bool fixed = table.has("fixed_at");
    SceneRigidBody b{name,
                     fixed,
                     table.vector(fixed ? "fixed_at" : "position", 3),
                     fixed ? SceneVector{} : table.vector("velocity", 3),
                     table.number("mass"),
                     table.vector("center", 3),
                     table.matrix("second_moment", 3),
                     table.matrix("directors", 3),
                     table.vector("angular_velocity", 3),
                     table.line()};
    table.finish();
    rigid_.insert(b.name);
    scene_.rigid_bodies.push_back(std::move(b));
  }

  /// Refuses a name that is not among the bodies (and points).
  void check_name(const TomlTable& table, const std::string& name, bool point_allowed) const {
    if (bodies_.contains(name) || (point_allowed && points_.contains(name))) return;
    if (points_.contains(name)) table.fail("'" + name + "' is a fixed point; a body is needed");
    if (rigid_.contains(name)) table.fail("'" + name + "' is a rigid body; a body of [[body]] is needed");
    std::vector<std::string> candidates(bodies_.begin(), bodies_.end());
    if (point_allowed) candidates.insert(candidates.end(), points_.begin(), points_.end());
    const std::string guess = nearest(name, candidates);
    table.fail("there is no body '" + name + "'" + (guess.empty() ? "" : ": did you mean '" + guess + "'?"));
  }

  std::array<std::string, 2> pair(TomlTable& table, std::string_view key) const {
    const std::vector<std::string> names = table.strings(key);
    if (names.size() != 2) table.fail("'" + std::string(key) + "' must name two bodies or points");
    check_pair(table, key, names[0], names[1]);
    return {names[0], names[1]};
  }

  void check_pair(const TomlTable& table, std::string_view key, const std::string& a, const std::string& b) const {
    check_name(table, a, true);
    check_name(table, b, true);
    if (a == b) table.fail("'" + std::string(key) + "' names '" + a + "' twice");
  }

  void constraint(TomlTable table) {
    SceneConstraint c;
    c.kind = table.string("kind");
    table.rename("constraint " + std::to_string(scene_.constraints.size() + 1) + " (" + c.kind + ")");
    c.line = table.line();
    const bool known = with_constraint_form<double>(c.kind, [&]<class Form>() {
      for (const ConstraintKey& key : Form::keys) value(table, key, c);
    });
    if (!known) {
      const std::string guess = nearest(c.kind, constraint_kinds());
      table.fail("unknown kind of constraint" + (guess.empty() ? "" : ": did you mean '" + guess + "'?"));
    }
    const auto fixed = [&](const auto& pair) {
      return points_.contains(pair.second[0]) && points_.contains(pair.second[1]);
    };
    if (!c.pairs.empty() && c.bodies.empty() && std::all_of(c.pairs.begin(), c.pairs.end(), fixed))
      table.fail(c.pairs.size() == 1 ? "both ends are fixed points" : "all ends are fixed points");
    table.finish();
    scene_.constraints.push_back(std::move(c));
  }

  void value(TomlTable& table, const ConstraintKey& key, SceneConstraint& c) const {
    using Takes = ConstraintKey::Takes;
    switch (key.takes) {
      case Takes::pair:
        c.pairs.emplace(key.name, pair(table, key.name));
        break;
      case Takes::body: {
        const std::string name = table.string(key.name);
        check_name(table, name, false);
        c.bodies.emplace(key.name, name);
        break;
      }
      case Takes::number:
        c.numbers.emplace(key.name, table.number(key.name));
        break;
      case Takes::vector:
        c.vectors.emplace(key.name, table.vector(key.name, d_));
        break;
      case Takes::symmetric_matrix:
        c.matrices.emplace(key.name, table.matrix(key.name, d_));
        break;
    }
  }

  void effect(TomlTable table) {
    SceneEffect e;
    e.kind = table.string("kind");
    e.line = table.line();
    table.rename("effect " + std::to_string(scene_.effects.size() + 1) + " (" + e.kind + ")");
    const bool known = with_effect(e.kind, [&]<class Effect>() {
      for (const EffectKey& key : Effect::keys) {
        if (key.is_vector)
          e.vectors.emplace(key.name, table.vector(key.name, d_));
        else if (key.fallback.empty() || table.has(key.name))
          e.numbers.emplace(key.name, table.number(key.name));
        else {
          table.take(key.name);
          e.numbers.emplace(key.name, Expression::parse(key.fallback));
        }
      }
      acts(table, e, Effect::acts);
    });
    if (!known) {
      const std::string guess = nearest(e.kind, effect_kinds());
      table.fail("unknown kind of effect" + (guess.empty() ? "" : ": did you mean '" + guess + "'?"));
    }
    table.finish();
    scene_.effects.push_back(std::move(e));
  }

  static std::vector<std::string> effect_kinds() {
    std::vector<std::string> kinds;
    std::apply([&](auto... effect) { (kinds.emplace_back(decltype(effect)::kind), ...); }, Effects{});
    return kinds;
  }

  void acts(TomlTable& table, SceneEffect& e, Acts acts) const {
    if (acts == Acts::about_a_center) {
      e.center = table.string("center");
      if (!points_.contains(e.center))
        table.fail("'center' must name a [[point]]; there is none called '" + e.center + "'");
    }
    if (acts != Acts::between_pairs) {
      table.take("on");
      if (!table.has("on")) return;
      e.on = table.strings("on");
      for (const std::string& name : *e.on) check_name(table, name, false);
      for (std::size_t i = 0; i < e.on->size(); ++i)
        if (std::count(e.on->begin(), e.on->end(), (*e.on)[i]) > 1) table.fail("'on' names '" + (*e.on)[i] + "' twice");
      return;
    }
    const toml::node* const between = table.take("between");
    if (!between) return;
    e.between.emplace();
    const toml::array* const array = between->as_array();
    const bool list = array && !array->empty() && array->front().is_array();
    if (!list) {
      const auto names = pair(table, "between");
      e.between->emplace_back(names[0], names[1]);
      return;
    }
    for (const toml::node& entry : *array) {
      const toml::array* const names = entry.as_array();
      if (!names || names->size() != 2) table.fail(entry, "each pair of 'between' must name two bodies or points");
      const std::string a = table.to_string((*names)[0], "each name"), b = table.to_string((*names)[1], "each name");
      check_pair(table, "between", a, b);
      for (const auto& [x, y] : *e.between)
        if ((x == a && y == b) || (x == b && y == a))
          table.fail(entry, "the pair '" + a + "', '" + b + "' stands twice");
      e.between->emplace_back(a, b);
    }
  }

  const TomlSource& source_;
  Scene& scene_;
  std::size_t d_ = 0;
  std::set<std::string> names_, points_, bodies_, rigid_;
};

}  // namespace

Scene read_scene(const std::string& toml, const std::string& name) {
  const TomlSource source(toml, name);
  const toml::table root = source.parse();
  Scene scene;
  scene.name = name;
  SceneReader(source, scene).read(root);
  return scene;
}

Scene load_scene(const std::string& path_or_name) {
  for (const auto& [name, text] : built_in_scenes())
    if (name == path_or_name) return read_scene(text, name);
  std::ifstream file(path_or_name, std::ios::binary);
  std::string text;
  if (file) {
    constexpr std::size_t limit = 10'000'000;
    char buffer[65536];
    while (text.size() <= limit && (file.read(buffer, sizeof buffer) || file.gcount() > 0))
      text.append(buffer, static_cast<std::size_t>(file.gcount()));
    if (text.size() > limit) throw InputError(path_or_name + ": too large for a scene");
    if (!file.bad() && (!text.empty() || file.eof())) return read_scene(text, path_or_name);
  }
  std::vector<std::string> names;
  for (const auto& [name, unused] : built_in_scenes()) names.push_back(name);
  const std::string guess = nearest(path_or_name, names);
  throw InputError("unknown scene '" + path_or_name + "': no readable file and no built-in scene" +
                   (guess.empty() ? std::string("; see `hbvm scenes`") : "; did you mean '" + guess + "'?"));
}

}  // namespace hbvm
