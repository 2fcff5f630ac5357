#include "problem/constraint/registry.hpp"
#include "scene/scene.hpp"

namespace hbvm::core {
namespace {

/// A string in quotes. What may not stand in one as it is, or is refused in a file, is written as its number.
std::string quoted(const std::string& text) {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF", digits = "0123456789ABCDEF";
  std::string result = "\"";
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto c = static_cast<unsigned char>(text[i]);
    if (std::string_view(text).substr(i).starts_with(byte_order_mark)) {
      result += "\\uFEFF";
      i += byte_order_mark.size() - 1;
    } else if (c < ' ' || c == 0x7F) {
      result += {'\\', 'u', '0', '0', digits[c / 16], digits[c % 16]};
    } else {
      if (c == '"' || c == '\\') result += '\\';
      result += text[i];
    }
  }
  return result + "\"";
}

std::string text(const std::string& name) { return quoted(name); }
std::string text(const Expression& e) { return quoted(e.text()); }

/// A vector, a matrix, names or pairs of names.
template <class List>
std::string text(const List& items) {
  std::string result;
  for (const auto& item : items) result += (result.empty() ? "[" : ", ") + text(item);
  return result.empty() ? "[]" : result + "]";
}

std::string text(const SceneShape& shape) {
  const bool one = shape.sizes.size() == 1;
  std::string result = "{ " + shape.kind + " = " + (one ? text(shape.sizes.front()) : text(shape.sizes));
  if (!shape.axis.empty()) result += ", axis = " + text(shape.axis);
  if (!shape.at.empty()) result += ", at = " + text(shape.at);
  return result + " }";
}

class Writer {
 public:
  /// Of a constraint also what it holds for, which an effect says itself.
  void formula(const std::string& name, const SceneFormula& f) {
    key(name, quoted(f.expression.text()));
    if (f.of.empty()) return;
    if (f.acts == Acts::on_each_body)
      key("on", quoted(f.of.front()));
    else
      key(f.acts == Acts::between_pairs ? "between" : "of", text(f.of));
  }

  void table(const std::string& name) { out += "\n[[" + name + "]]\n"; }
  void key(const std::string& name, const std::string& value) { out += name + " = " + value + "\n"; }
  void optional(const std::string& name, const std::optional<Expression>& value) {
    if (value) key(name, text(*value));
  }
  std::string out;
};

}  // namespace

std::string write_scene(const Scene& scene) {
  Writer w;
  w.key("title", quoted(scene.title));
  w.key("source", quoted(scene.source));
  w.key("dimension", std::to_string(scene.dimension));
  if (!scene.observables.empty()) w.key("observables", text(scene.observables));
  if (!scene.constants.empty()) {
    w.out += "\n[constants]\n";
    for (const auto& [name, value] : scene.constants) w.key(name, text(value));
  }
  for (const ScenePoint& p : scene.points) {
    w.table("point");
    w.key("name", quoted(p.name));
    w.key("position", text(p.position));
    w.optional("charge", p.charge);
  }
  for (const SceneBody& b : scene.bodies) {
    w.table("body");
    w.key("name", quoted(b.name));
    w.key("mass", b.mass ? text(*b.mass) : text(*b.mass_matrix));
    w.key("position", text(b.position));
    if (!b.velocity.empty()) w.key("velocity", text(b.velocity));
    if (!b.momentum.empty()) w.key("momentum", text(b.momentum));
    w.optional("charge", b.charge);
  }
  for (const SceneRigidBody& b : scene.rigid_bodies) {
    w.table("rigid_body");
    w.key("name", quoted(b.name));
    w.key(b.fixed ? "fixed_at" : "position", text(b.position));
    if (!b.fixed) w.key("velocity", text(b.velocity));
    w.key("mass", text(b.mass));
    w.key("center", text(b.center));
    w.key("second_moment", text(b.second_moment));
    w.key("directors", text(b.directors));
    w.key("angular_velocity", scene.dimension == 2 ? text(b.angular_velocity.front()) : text(b.angular_velocity));
    if (b.shape) w.key("shape", text(*b.shape));
  }
  for (const SceneAttachment& a : scene.attachments) {
    w.table("attachment");
    w.key("name", quoted(a.name));
    w.key("of", quoted(a.of));
    w.key("at", text(a.at));
    w.optional("charge", a.charge);
  }
  for (const SceneConstraint& c : scene.constraints) {
    w.table("constraint");
    w.key("kind", quoted(c.kind));
    if (c.formula) w.formula("g", *c.formula);
    with_constraint_kind<double>(c.kind, [&]<class Kind>() {
      for (const ConstraintKey& key : Kind::keys) {
        const auto write = [&](const auto& values) {
          if (const auto value = values.find(key.name); value != values.end()) w.key(value->first, text(value->second));
        };
        write(c.pairs);
        write(c.bodies);
        write(c.numbers);
        write(c.vectors);
        write(c.matrices);
      }
    });
  }
  for (const SceneEffect& e : scene.effects) {
    w.table("effect");
    w.key("kind", quoted(e.kind));
    if (e.formula) w.formula("U", *e.formula);
    if (!e.center.empty()) w.key("center", quoted(e.center));
    for (const auto& [name, value] : e.numbers) w.key(name, text(value));
    for (const auto& [name, value] : e.vectors) w.key(name, text(value));
    for (const auto& [name, components] : e.formulas)
      w.key(name, components.size() == 1 ? text(components.front()) : text(components));
    if (e.kind == "torque" && e.on)
      w.key("on", quoted(e.on->front()));
    else if (e.on)
      w.key("on", text(*e.on));
    if (!e.of.empty()) w.key("of", text(e.of));
    if (e.is_mutual()) {
      w.key("between", text(std::vector<std::string>{e.between->front().first, e.between->front().second}));
    } else if (e.between) {
      std::vector<std::array<std::string, 2>> pairs;
      for (const auto& [a, b] : *e.between) pairs.push_back({a, b});
      w.key("between", text(pairs));
    }
  }
  for (const SceneObservation& o : scene.observations) {
    w.table("observe");
    w.key("name", quoted(o.name));
    w.key("value", quoted(o.value.text()));
  }
  for (const SceneEvent& event : scene.events) {
    w.table("event");
    w.key("name", quoted(event.name));
    w.key("value", quoted(event.value.text()));
    if (event.direction != Crossing::any) w.key("direction", event.direction == Crossing::up ? "\"up\"" : "\"down\"");
  }
  return w.out;
}

}  // namespace hbvm::core
