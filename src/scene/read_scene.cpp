#include <algorithm>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <set>
#include <sstream>

#include "nearest.hpp"
#include "problem/constraint/registry.hpp"
#include "problem/effect/registry.hpp"
#include "problem/force/registry.hpp"
#include "scene/add_event.hpp"
#include "scene/formula_names.hpp"
#include "scene/inertia.hpp"
#include "scene/orientation.hpp"
#include "scene/scene.hpp"
#include "scene/shape.hpp"
#include "toml/toml_table.hpp"

namespace hbvm::core {
namespace {

/// What may stand where a body is named.
struct Allowed {
  bool points = false, attachments = false, rigid_bodies = false;
};
/// At the ends of a constraint, and of an effect, which takes a rigid body by its centre of mass.
constexpr Allowed of_constraint{.points = true, .attachments = true},
    of_effect{.points = true, .attachments = true, .rigid_bodies = true};

/// Made when first asked for, since scenes may be read before main().
const std::set<std::string, std::less<>>& top_keys() {
  static const std::set<std::string, std::less<>> keys{"title",  "source",  "dimension",  "observables", "constants",
                                                       "point",  "body",    "rigid_body", "attachment",  "constraint",
                                                       "effect", "observe", "event"};
  return keys;
}

class SceneReader {
 public:
  SceneReader(const TomlSource& source, Scene& scene) : source_(source), scene_(scene) {}

  void read(const toml::table& root) {
    TomlTable top(source_, root, "scene");
    top.expect({top_keys().begin(), top_keys().end()});
    scene_.title = top.optional_string("title");
    scene_.source = top.optional_string("source");
    const long dimension = top.integer("dimension");
    if (dimension < 1 || dimension > 3) top.fail(top.require("dimension"), "'dimension' must be 1, 2 or 3");
    scene_.dimension = static_cast<int>(dimension);
    d_ = static_cast<std::size_t>(dimension);
    if (const toml::node* const node = top.take("constants")) constants(*node, top);
    for (const toml::table* table : top.tables("point")) point(TomlTable(source_, *table, "point"));
    for (const toml::table* table : top.tables("body")) body(TomlTable(source_, *table, "body"));
    for (const toml::table* table : top.tables("rigid_body")) rigid_body(TomlTable(source_, *table, "rigid_body"));
    for (const toml::table* table : top.tables("attachment")) attachment(TomlTable(source_, *table, "attachment"));
    for (const toml::table* table : top.tables("constraint")) constraint(TomlTable(source_, *table, "constraint"));
    for (const toml::table* table : top.tables("effect")) effect(TomlTable(source_, *table, "effect"));
    if (const toml::node* const node = top.take("observables")) {
      scene_.observables = top.strings("observables");
      const std::vector<std::string> known{"energy", "linear_momentum", "angular_momentum"};
      for (const std::string& name : scene_.observables)
        if (std::count(known.begin(), known.end(), name) == 0)
          top.fail(*node, "unknown observable '" + name + "'" + did_you_mean_or_list(name, known));
    }
    for (const toml::table* table : top.tables("observe")) observe(TomlTable(source_, *table, "observe"));
    for (const toml::table* table : top.tables("event")) event(TomlTable(source_, *table, "event"));
    if (scene_.bodies.empty() && scene_.rigid_bodies.empty()) top.fail("there is no [[body]]");
  }

 private:
  void constants(const toml::node& node, const TomlTable& top) {
    const toml::table* const table = node.as_table();
    if (!table) top.fail(node, "'constants' must be a table");
    TomlTable reader(source_, *table, "constants");
    for (const auto& [key, value] : *table) {
      const std::string name(key.str());
      const bool is_number = value.is_number() || value.is_string();
      if (source_.is_top_key(name) && (!is_number || name == "title" || name == "source"))
        reader.misplaced(name, value);
      bool valid = !name.empty() && !(name[0] >= '0' && name[0] <= '9');
      for (const char c : name)
        valid = valid && ((c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_');
      if (!valid || Expression::reserved_words().contains(name))
        reader.fail(value, "'" + name + "' cannot be the name of a constant");
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
    for (const char* key : {"velocity", "momentum"}) table.take(key);
    table.finish();
    bodies_.insert(b.name);
    scene_.bodies.push_back(std::move(b));
  }

  /// Whether a table has the first key and not the second; without both, the second is missed in the end.
  static bool either(TomlTable& table, const std::string& key, const std::string& other) {
    if (table.has(key) && table.has(other)) table.fail("give '" + key + "' or '" + other + "', not both");
    if (!table.has(key) && !table.has(other)) table.missing({other, key});
    table.take(table.has(key) ? other : key);
    return table.has(key);
  }

  void rigid_body(TomlTable table) {
    if (d_ == 1) table.fail("a rigid body turns: it needs dimension = 2 or 3");
    const std::string name = new_name(table, "rigid_body");
    const bool fixed = table.has("fixed_at");
    if (!fixed) table.take("fixed_at");
    const bool by_inertia = either(table, "inertia", "second_moment");
    const bool by_orientation = either(table, "orientation", "directors");
    const Expression mass = table.number("mass");
    // Of an inertia about the centre of mass the reference point is that centre, unless another is given.
    const SceneVector center =
        by_inertia && !table.has("center") ? SceneVector(d_, Expression::parse("0")) : table.vector("center", d_);
    table.take("center");
    SceneRigidBody b{
        name,
        fixed,
        table.vector(fixed ? "fixed_at" : "position", d_),
        fixed ? SceneVector{} : table.vector("velocity", d_),
        mass,
        center,
        by_inertia ? second_moment_of(read_inertia(table, d_), mass, center) : table.matrix("second_moment", d_),
        by_orientation ? read_orientation(table, d_, scene_.constants) : table.matrix("directors", d_),
        d_ == 2 ? SceneVector{table.number("angular_velocity")} : table.vector("angular_velocity", 3),
        table.line()};
    if (table.take("shape")) b.shape = read_shape(table, d_, scene_.constants);
    table.finish();
    rigid_.insert(b.name);
    scene_.rigid_bodies.push_back(std::move(b));
  }

  void observe(TomlTable table) {
    const std::string name = table.string("name"), text = table.string("value");
    table.finish();
    for (const SceneObservation& other : scene_.observations)
      if (other.name == name) table.fail("'" + name + "' is observed already");
    try {
      scene_.observations.push_back({name, Expression::parse(text, Expression::Syntax::observation), table.line()});
    } catch (const ExpressionError& error) {
      table.fail(std::string("'value': ") + error.what());
    }
  }

  void event(TomlTable table) {
    const std::string name = table.string("name"), text = table.string("value"),
                      direction = table.optional_string("direction");
    table.finish();
    try {
      add_event(scene_, name, text, direction, table.line());
    } catch (const InputError& error) {
      table.fail(error.what());
    }
  }

  void attachment(TomlTable table) {
    const std::string name = new_name(table, "attachment");
    add_attachment(table, name, table.string("of"), table.vector("at", d_));
  }

  /// \param table with the body and the point read
  void add_attachment(TomlTable& table, const std::string& name, const std::string& of, SceneVector at) {
    SceneAttachment a{name, of, std::move(at), table.optional_number("charge"), table.line()};
    table.finish();
    if (!rigid_.contains(of))
      table.fail(bodies_.contains(of) || points_.contains(of) || attachments_.contains(of)
                     ? "'" + of + "' is no rigid body"
                     : "there is no rigid body '" + of + "'" + did_you_mean(of, {rigid_.begin(), rigid_.end()}));
    attachments_.emplace(name, of);
    scene_.attachments.push_back(std::move(a));
  }

  /// A table { of = "bar", at = [...] } where a name may stand: the attachment "bar[...]", which may stand elsewhere.
  std::string attachment_in_place(TomlTable table) {
    const std::string of = table.string("of");
    SceneVector at = table.vector("at", d_);
    std::string name = of + "[";
    for (const Expression& e : at) name += (&e == &at.front() ? "" : ", ") + e.text();
    name += "]";
    const auto known = std::find_if(scene_.attachments.begin(), scene_.attachments.end(),
                                    [&](const SceneAttachment& a) { return a.name == name; });
    if (known == scene_.attachments.end()) {
      if (!names_.insert(name).second) table.fail("there is another body or point called '" + name + "'");
      add_attachment(table, name, of, std::move(at));
      return name;
    }
    const auto charge = table.optional_number("charge");
    table.finish();
    const auto differs = [](const Expression& a, const Expression& b) { return a.text() != b.text(); };
    if (known->of != of || !std::equal(at.begin(), at.end(), known->at.begin(), known->at.end(), std::not_fn(differs)))
      table.fail("there is another attachment called '" + name + "'");
    if (charge && known->charge && differs(*charge, *known->charge))
      table.fail("'" + name + "' has the charge " + known->charge->text() + " elsewhere");
    if (charge) known->charge = charge;
    return name;
  }

  /// Refuses a name that is not among the bodies or what is allowed besides.
  void check_name(const TomlTable& table, const std::string& name, const Allowed& allowed) const {
    if (bodies_.contains(name) || (allowed.points && points_.contains(name)) ||
        (allowed.attachments && attachments_.contains(name)) || (allowed.rigid_bodies && rigid_.contains(name)))
      return;
    if (points_.contains(name)) table.fail("'" + name + "' is a fixed point; a body is needed");
    if (rigid_.contains(name))
      table.fail("'" + name + "' is a rigid body; " +
                 (allowed.attachments ? "name a point of it: { of = \"" + name + "\", at = [...] }"
                                      : "a body of [[body]] is needed"));
    if (const auto at = attachments_.find(name); at != attachments_.end())
      table.fail("'" + name + "' is a point of a rigid body; " +
                 (allowed.rigid_bodies ? "name the rigid body, '" + at->second + "'" : "a body of [[body]] is needed"));
    std::vector<std::string> candidates(bodies_.begin(), bodies_.end());
    if (allowed.points) candidates.insert(candidates.end(), points_.begin(), points_.end());
    if (allowed.rigid_bodies) candidates.insert(candidates.end(), rigid_.begin(), rigid_.end());
    if (allowed.attachments)
      for (const auto& [attachment, of] : attachments_) candidates.push_back(attachment);
    table.fail("there is no body '" + name + "'" + did_you_mean(name, candidates));
  }

  /// A name, or the name of the attachment that a table describes in place.
  std::string name(const TomlTable& table, const toml::node& node, const std::string& where) {
    if (const toml::table* const place = node.as_table())
      return attachment_in_place(TomlTable(source_, *place, table.what() + ": a point of a rigid body"));
    return table.to_string(node, where);
  }

  std::vector<std::string> names(TomlTable& table, std::string_view key) {
    const toml::node& node = table.require(key);
    const toml::array* const array = node.as_array();
    if (!array) table.fail(node, "'" + std::string(key) + "' must be an array of names");
    std::vector<std::string> result;
    for (const toml::node& entry : *array)
      result.push_back(name(table, entry, "each entry of '" + std::string(key) + "'"));
    return result;
  }

  std::array<std::string, 2> pair(TomlTable& table, std::string_view key, const Allowed& allowed) {
    const std::vector<std::string> ends = names(table, key);
    if (ends.size() != 2) table.fail("'" + std::string(key) + "' must name two bodies or points");
    check_names(table, key, ends, allowed);
    return {ends[0], ends[1]};
  }

  void check_names(const TomlTable& table, std::string_view key, const std::vector<std::string>& names,
                   const Allowed& allowed) const {
    for (const std::string& name : names) check_name(table, name, allowed);
    for (const std::string& name : names)
      if (std::count(names.begin(), names.end(), name) > 1)
        table.fail("'" + std::string(key) + "' names '" + name + "' twice");
  }

  /// What a body or point moves with: itself, its rigid body, or nothing for a fixed point.
  std::string carrier(const std::string& name) const {
    const auto at = attachments_.find(name);
    return at != attachments_.end() ? at->second : points_.contains(name) ? std::string() : name;
  }

  /// Refuses ends that all move together, at distances that never change.
  void check_ends(const TomlTable& table, const std::vector<std::string>& ends) const {
    std::set<std::string> carriers;
    for (const std::string& end : ends) carriers.insert(carrier(end));
    if (carriers.size() > 1) return;
    const std::string all = ends.size() == 2 ? "both" : "all", &of = *carriers.begin();
    table.fail(all + " ends are " +
               (of.empty() ? "points whose motion is given" : "points of the rigid body '" + of + "'"));
  }

  void constraint(TomlTable table) {
    SceneConstraint c;
    c.kind = table.string("kind");
    table.rename("constraint " + std::to_string(scene_.constraints.size() + 1) + " (" + c.kind + ")");
    c.line = table.line();
    if (c.kind == "formula") {
      formula_constraint(table, c);
      return;
    }
    const bool known = with_constraint_kind<double>(c.kind, [&]<class Kind>() {
      if constexpr (requires { Kind::in_space_only; })
        if (d_ != 3) table.fail("it needs dimension = 3; " + std::string(Kind::in_space_only));
      for (const ConstraintKey& key : Kind::keys) value(table, key, c);
    });
    if (!known)
      table.fail("unknown kind of constraint" + did_you_mean_or_list(c.kind, with_formula(constraint_kinds())) +
                 ". Constraints are equations for positions: rolling, contact and slack ropes are beyond this program");
    std::vector<std::string> ends;
    for (const auto& [key, pair] : c.pairs) ends.insert(ends.end(), pair.begin(), pair.end());
    if (!ends.empty() && c.bodies.empty()) check_ends(table, ends);
    table.finish();
    scene_.constraints.push_back(std::move(c));
  }

  static std::vector<std::string> with_formula(std::vector<std::string> kinds) {
    kinds.emplace_back("formula");
    return kinds;
  }

  /// The formula of a key, and what its names are about.
  SceneFormula formula(TomlTable& table, std::string_view key, Acts acts, std::vector<std::string> of) {
    const toml::node& node = table.require(key);
    const std::string text = table.to_string(node, "'" + std::string(key) + "'");
    const toml::source_position at = source_.begin_of(text, node.source());
    const TextBegin begin{at.line, at.column};
    try {
      SceneFormula result{Expression::parse(text, Expression::Syntax::formula), acts, std::move(of), begin};
      names_used(result, scene_.dimension, scene_.constants);
      return result;
    } catch (const ExpressionError& error) {
      table.fail(node, "'" + std::string(key) + "', " + begin.place(text, error.at()) + ": " + error.reason());
    }
  }

  /// Which of some keys stands in a table of a formula, the last if none does.
  std::string key_of(TomlTable& table, const std::vector<std::string>& keys) {
    std::string found;
    for (const std::string& key : keys) {
      if (!table.take(key)) continue;
      if (!found.empty()) table.fail("give either '" + found + "' or '" + key + "'");
      found = key;
    }
    return found;
  }

  /// The bodies and points of 'of', one of which moves.
  std::vector<std::string> group(TomlTable& table, const Allowed& allowed) {
    std::vector<std::string> of = names(table, "of");
    if (of.empty()) table.fail("'of' must name a body");
    check_names(table, "of", of, allowed);
    if (std::all_of(of.begin(), of.end(), [&](const std::string& name) { return points_.contains(name); }))
      table.fail("'of' names fixed points alone");
    return of;
  }

  void formula_constraint(TomlTable& table, SceneConstraint& c) {
    const std::string key = key_of(table, {"on", "between", "of"});
    if (key.empty()) table.missing({"on", "between", "of"});
    if (key == "on") {
      const std::string body = name(table, table.require("on"), "'on'");
      check_name(table, body, {.attachments = true});
      c.formula = formula(table, "g", Acts::on_each_body, {body});
    } else if (key == "between") {
      const auto ends = pair(table, "between", of_constraint);
      check_ends(table, {ends.begin(), ends.end()});
      c.formula = formula(table, "g", Acts::between_pairs, {ends.begin(), ends.end()});
    } else {
      std::vector<std::string> of = group(table, of_constraint);
      c.formula = formula(table, "g", Acts::on_group, std::move(of));
    }
    table.finish();
    scene_.constraints.push_back(std::move(c));
  }

  void formula_effect(TomlTable& table, SceneEffect& e) {
    const std::string key = key_of(table, {"center", "between", "of"});
    if (key == "of") {
      std::vector<std::string> of = group(table, of_effect);
      e.formula = formula(table, "U", Acts::on_group, std::move(of));
    } else {
      const Acts how = key.empty() ? Acts::on_each_body : key == "center" ? Acts::about_a_center : Acts::between_pairs;
      acts(table, e, how);
      e.formula = formula(table, "U", how, {});
    }
    table.finish();
    scene_.effects.push_back(std::move(e));
  }

  void value(TomlTable& table, const ConstraintKey& key, SceneConstraint& c) {
    if (key.optional && !table.has(key.name)) {
      table.take(key.name);
      return;
    }
    using Takes = ConstraintKey::Takes;
    switch (key.takes) {
      case Takes::pair:
        c.pairs.emplace(key.name, pair(table, key.name, of_constraint));
        break;
      case Takes::body: {
        std::string body = name(table, table.require(key.name), "'" + std::string(key.name) + "'");
        check_name(table, body, {.attachments = true});
        c.bodies.emplace(key.name, std::move(body));
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

  /// The formula that a value is, and a number is one, too.
  static Expression formula_of(const TomlTable& table, const toml::node& node, const std::string& where) {
    const auto text = node.value_exact<std::string>();
    if (!text) return table.to_number(node, where);
    try {
      return Expression::parse(*text, Expression::Syntax::formula);
    } catch (const ExpressionError& error) {
      table.fail(node, where + ": " + error.what());
    }
  }

  std::vector<Expression> formulas_of(TomlTable& table, const std::string& key, std::size_t components,
                                      const FormulaNames& known) {
    const toml::node& node = table.require(key);
    const std::string where = "'" + key + "'";
    std::vector<Expression> result;
    const toml::array* const array = node.as_array();
    if (!array && components == 1) {
      result.push_back(formula_of(table, node, where));
    } else if (!array || array->size() != components) {
      table.fail(node, where + " must " +
                           (components == 1 ? "be a number or a formula"
                                            : "have " + std::to_string(components) + " components"));
    } else {
      for (const toml::node& entry : *array) result.push_back(formula_of(table, entry, where));
    }
    for (const Expression& formula : result) {
      try {
        names_used(formula, known, scene_.constants);
      } catch (const ExpressionError& error) {
        table.fail(node, where + ", " + formula.text() + ": " + error.reason());
      }
    }
    return result;
  }

  /// Whom a force acts on.
  void acts(TomlTable& table, SceneEffect& e, ForceOn on) {
    const auto check_bodies = [&](const std::vector<std::string>& who) {
      for (const std::string& body : who)
        if (!rigid_.contains(body)) table.fail("'" + body + "' is no rigid body");
    };
    switch (on) {
      case ForceOn::pair:
        table.require("between");
        return acts(table, e, Acts::between_pairs);
      case ForceOn::rigid_bodies: {
        const std::vector<std::string> ends = names(table, "between");
        if (ends.size() != 2 || ends[0] == ends[1]) table.fail("'between' must name two rigid bodies");
        check_bodies(ends);
        e.between.emplace();
        e.between->emplace_back(ends[0], ends[1]);
        return;
      }
      case ForceOn::rigid_body:
        e.on = {table.string("on")};
        return check_bodies(*e.on);
      default:
        break;
    }
    if (e.kind == "force" && table.has("of")) {
      e.of = group(table, of_effect);
      return;
    }
    if (!table.take("on")) return;
    e.on = names(table, "on");
    check_names(table, "on", *e.on, {.attachments = on != ForceOn::inertia, .rigid_bodies = true});
  }

  template <class Force>
  void force(TomlTable& table, SceneEffect& e) {
    const bool about_axis = e.kind == "torque" && table.take("along");
    acts(table, e, Force::on);
    for (const ForceKey& key : Force::keys) {
      const std::string name(key.name);
      using Components = ForceKey::Components;
      if (key.components == Components::axial && d_ == 1) table.fail("it needs dimension = 2 or 3");
      std::size_t components = key.components == Components::one || about_axis ? 1 : d_;
      if (key.components == Components::axial && d_ == 2) components = 1;
      if (key.name == "F" && !e.of.empty()) components = d_ * e.of.size();
      if (!key.fallback.empty() && !table.take(name))
        e.formulas[name].assign(components, Expression::parse(key.fallback));
      else
        e.formulas[name] = formulas_of(table, name, components, force_names(e.of, key.local, scene_.dimension));
    }
    if (!about_axis) return;
    if (d_ != 3) table.fail("'along' needs dimension = 3");
    e.formulas["along"] = formulas_of(table, "along", 3, {});
  }

  void effect(TomlTable table) {
    SceneEffect e;
    e.kind = table.string("kind");
    e.line = table.line();
    table.rename("effect " + std::to_string(scene_.effects.size() + 1) + " (" + e.kind + ")");
    if (e.kind == "formula") {
      formula_effect(table, e);
      return;
    }
    const bool mutual = e.kind == "torque" && table.has("between");
    if (e.kind == "torque") table.take(mutual ? "on" : "between");
    if (with_force(e.kind, mutual, [&]<class Force>() { force<Force>(table, e); })) {
      table.finish();
      scene_.effects.push_back(std::move(e));
      return;
    }
    const toml::node* const damping = e.kind == "spring" ? table.take("damping") : nullptr;
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
    if (!known)
      table.fail("unknown kind of effect" + did_you_mean_or_list(e.kind, with_formula(effect_kinds())) +
                 ". Forces are smooth: dry friction and contact are beyond this program");
    table.finish();
    scene_.effects.push_back(e);
    if (!damping) return;
    SceneEffect damper;
    damper.kind = Damper::kind;
    damper.line = e.line;
    damper.between = e.between;
    damper.formulas["coefficient"] = {formula_of(table, *damping, "'damping'")};
    scene_.effects.push_back(std::move(damper));
  }

  static std::vector<std::string> effect_kinds() {
    std::vector<std::string> kinds;
    std::apply([&](auto... effect) { (kinds.emplace_back(decltype(effect)::kind), ...); }, Effects{});
    const auto add_force = [&](auto force) {
      if (std::string kind(decltype(force)::kind); kinds.back() != kind) kinds.push_back(std::move(kind));
    };
    std::apply([&](auto... force) { (add_force(force), ...); }, Forces{});
    return kinds;
  }

  void acts(TomlTable& table, SceneEffect& e, Acts acts) {
    if (acts == Acts::about_a_center) {
      e.center = table.string("center");
      if (!points_.contains(e.center))
        table.fail("'center' must name a [[point]]; there is none called '" + e.center + "'");
    }
    if (acts != Acts::between_pairs) {
      table.take("on");
      if (!table.has("on")) return;
      e.on = names(table, "on");
      const bool each = acts == Acts::on_each_body;  // which need a mass, and a point of a rigid body has none
      check_names(table, "on", *e.on, {.attachments = !each, .rigid_bodies = true});
      return;
    }
    const toml::node* const between = table.take("between");
    if (!between) return;
    e.between.emplace();
    const toml::array* const array = between->as_array();
    const bool list = array && !array->empty() && array->front().is_array();
    if (!list) {
      const auto ends = pair(table, "between", of_effect);
      check_rigid(table, ends);
      e.between->emplace_back(ends[0], ends[1]);
      return;
    }
    for (const toml::node& entry : *array) {
      const toml::array* const ends = entry.as_array();
      if (!ends || ends->size() != 2) table.fail(entry, "each pair of 'between' must name two bodies or points");
      const std::string a = name(table, (*ends)[0], "each name"), b = name(table, (*ends)[1], "each name");
      check_names(table, "between", {a, b}, of_effect);
      check_rigid(table, {a, b});
      for (const auto& [x, y] : *e.between)
        if ((x == a && y == b) || (x == b && y == a))
          table.fail(entry, "the pair '" + a + "', '" + b + "' stands twice");
      e.between->emplace_back(a, b);
    }
  }

  /// Refuses a force within a rigid body.
  void check_rigid(const TomlTable& table, const std::array<std::string, 2>& ends) const {
    if (!carrier(ends[0]).empty()) check_ends(table, {ends.begin(), ends.end()});
  }

  const TomlSource& source_;
  Scene& scene_;
  std::size_t d_ = 0;
  std::set<std::string> names_, points_, bodies_, rigid_;
  std::map<std::string, std::string> attachments_;  // with their rigid bodies
};

}  // namespace

Scene read_scene(const std::string& toml, const std::string& name) {
  const TomlSource source(toml, name, top_keys());
  const toml::table root = source.parse();
  Scene scene;
  scene.name = name;
  SceneReader(source, scene).read(root);
  return scene;
}

std::vector<std::pair<std::string, std::string>> all_scenes() {
  std::vector<std::pair<std::string, std::string>> all = built_in_scenes();
  all.insert(all.end(), test_set_scenes().begin(), test_set_scenes().end());
  return all;
}

std::string scene_text(const std::string& path_or_name) {
  for (const auto* const scenes : {&built_in_scenes(), &test_set_scenes()})
    for (const auto& [name, text] : *scenes)
      if (name == path_or_name) return text;
  std::ifstream file(path_or_name, std::ios::binary);
  std::string text;
  if (file) {
    constexpr std::size_t limit = 10'000'000;
    char buffer[65536];
    while (text.size() <= limit && (file.read(buffer, sizeof buffer) || file.gcount() > 0))
      text.append(buffer, static_cast<std::size_t>(file.gcount()));
    if (text.size() > limit) throw InputError(path_or_name + ": too large for a scene");
    if (!file.bad() && (!text.empty() || file.eof())) return text;
  }
  std::vector<std::string> names;
  for (const auto& [name, unused] : all_scenes()) names.push_back(name);
  const std::string guess = nearest(path_or_name, names);
  throw InputError("unknown scene '" + path_or_name + "': no readable file and no built-in scene" +
                   (guess.empty() ? std::string("; see `hbvm scenes`") : "; did you mean '" + guess + "'?"));
}

Scene load_scene(const std::string& path_or_name) { return read_scene(scene_text(path_or_name), path_or_name); }

}  // namespace hbvm::core
