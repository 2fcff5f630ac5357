#include <fmt/format.h>

#include "door/door.hpp"
#include "hbvm/error.hpp"
#include "hbvm/scene.hpp"
#include "scalar/with_scalar.hpp"
#include "scene/add_event.hpp"
#include "scene/assemble.hpp"
#include "scene/hold.hpp"
#include "scene/observe.hpp"
#include "scene/project.hpp"
#include "scene/scene.hpp"
#include "scene/set_number.hpp"
#include "scene/with_start.hpp"

namespace hbvm {
namespace {

/// A string of TOML.
std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      result += std::string("\\") + c;
    else if (static_cast<unsigned char>(c) < ' ' || c == '\x7f')
      result += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    else
      result += c;
  }
  return result + '"';
}

std::string toml(const std::string& text) { return quoted(text); }
std::string toml(const Number& number) { return quoted(number.text()); }
template <class T>
std::string toml(const std::vector<T>& list) {
  std::string result;
  for (const T& item : list) result += (result.empty() ? "" : ", ") + toml(item);
  return "[" + result + "]";
}

/// One table of a scene file, line by line.
class SceneTable {
 public:
  explicit SceneTable(const std::string& kind) : text_("\n[[" + kind + "]]\n") {}
  template <class T>
  SceneTable& key(const std::string& name, const T& value) {
    text_ += name + " = " + toml(value) + "\n";
    return *this;
  }
  /// Unless it is empty.
  template <class T>
  SceneTable& some(const std::string& name, const T& value) {
    return value.empty() ? *this : key(name, value);
  }
  template <class T>
  SceneTable& all(const std::map<std::string, T>& values) {
    for (const auto& [name, value] : values) key(name, value);
    return *this;
  }
  /// A table in one line.
  SceneTable& inline_table(const std::string& name, const SceneTable& entries) {
    std::string inside = entries.text_.substr(entries.text_.find("]]\n") + 3);
    for (char& c : inside)
      if (c == '\n') c = ',';
    if (!inside.empty()) inside.pop_back();
    text_ += name + " = { " + inside + " }\n";
    return *this;
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

SceneTable shape_lines(const Shape& shape) {
  SceneTable table("shape");
  if (shape.size.size() == 1)
    table.key(shape.kind, shape.size.front());
  else
    table.key(shape.kind, shape.size);
  return table.some("axis", shape.axis).some("at", shape.at);
}

SceneTable orientation_lines(const Orientation& o) {
  SceneTable table("orientation");
  if (o.angle) table.key("angle", *o.angle);
  return table.some("axis", o.axis)
      .some("quaternion", o.quaternion)
      .some("euler", o.euler)
      .some("sequence", o.sequence);
}

/// A key that TOML takes without quotes, or one within them.
std::string toml_key(const std::string& name) {
  const bool bare = !name.empty() && name.find_first_not_of(
                                         "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                         "0123456789_-") == std::string::npos;
  return bare ? name : quoted(name);
}

std::string constant_line(const std::string& name, const Number& value) { return toml_key(name) + " = " + toml(value); }

}  // namespace

Scene::Scene(int dimension, std::string name) : name_(std::move(name)) {
  if (dimension < 1 || dimension > 3)
    throw InputError(fmt::format("a scene has dimension 1, 2 or 3, not {}", dimension));
  head_ = fmt::format("dimension = {}\n", dimension);
}

void Scene::take_apart() {
  if (!read_) return;
  const core::Scene& scene = *read_;
  const std::string text = core::write_scene(scene);
  head_ = "title = " + quoted(scene.title) + "\n";
  if (!scene.source.empty()) head_ += "source = " + quoted(scene.source) + "\n";
  head_ += fmt::format("dimension = {}\n", scene.dimension);
  observables_ = scene.observables;
  for (const auto& [name, value] : scene.constants) constants_.push_back(constant_line(name, value.text()));
  tables_ = text.substr(std::min(text.find("\n[["), text.size()));
  read_.reset();
}

Scene& Scene::title(const std::string& text) {
  take_apart();
  if (head_.starts_with("title")) head_.erase(0, head_.find('\n') + 1);
  head_ = "title = " + quoted(text) + "\n" + head_;
  return *this;
}

Scene& Scene::constant(const std::string& name, const Number& value) {
  take_apart();
  constants_.push_back(constant_line(name, value));
  return *this;
}

Scene& Scene::point(const std::string& name, const Numbers& position, const std::optional<Number>& charge) {
  take_apart();
  SceneTable table("point");
  table.key("name", name).key("position", position);
  if (charge) table.key("charge", *charge);
  tables_ += table.text();
  return *this;
}

Scene& Scene::body(const Body& body) {
  take_apart();
  SceneTable table("body");
  table.key("name", body.name);
  if (body.mass_matrix.empty())
    table.key("mass", body.mass);
  else
    table.key("mass", body.mass_matrix);
  table.key("position", body.position).some("momentum", body.momentum);
  if (body.momentum.empty())
    table.key("velocity", body.velocity.empty() ? Numbers(body.position.size(), 0) : body.velocity);
  else
    table.some("velocity", body.velocity);
  if (body.charge) table.key("charge", *body.charge);
  tables_ += table.text();
  return *this;
}

Scene& Scene::rigid_body(const RigidBody& body) {
  take_apart();
  SceneTable table("rigid_body");
  table.key("name", body.name).key(body.fixed ? "fixed_at" : "position", body.position);
  if (!body.fixed) table.key("velocity", body.velocity.empty() ? Numbers(body.position.size(), 0) : body.velocity);
  table.key("mass", body.mass).some("center", body.center).some("second_moment", body.second_moment);
  if (body.inertia.size() == 1 && body.inertia.front().size() == 1)
    table.key("inertia", body.inertia.front().front());
  else if (body.inertia.size() == 1)
    table.key("inertia", body.inertia.front());
  else
    table.some("inertia", body.inertia);
  table.some("directors", body.directors);
  if (body.orientation) table.inline_table("orientation", orientation_lines(*body.orientation));
  if (body.shape) table.inline_table("shape", shape_lines(*body.shape));
  if (body.angular_velocity.size() == 1)
    table.key("angular_velocity", body.angular_velocity.front());
  else
    table.key("angular_velocity", body.angular_velocity);
  tables_ += table.text();
  return *this;
}

Scene& Scene::attachment(const std::string& name, const std::string& of, const Numbers& at) {
  take_apart();
  tables_ += SceneTable("attachment").key("name", name).key("of", of).key("at", at).text();
  return *this;
}

Scene& Scene::constraint(const Constraint& constraint) {
  take_apart();
  SceneTable table("constraint");
  table.key("kind", constraint.kind).some("g", constraint.g).all(constraint.numbers).all(constraint.vectors);
  table.all(constraint.matrices);
  for (const auto& [name, names] : constraint.names)
    if (names.size() == 1)
      table.key(name, names.front());
    else
      table.key(name, names);
  tables_ += table.text();
  return *this;
}

Scene& Scene::rod(const std::string& a, const std::string& b, const Number& length) {
  return constraint({.kind = "rod", .names = {{"between", {a, b}}}, .numbers = {{"length", length}}});
}

Scene& Scene::effect(const Effect& effect) {
  take_apart();
  SceneTable table("effect");
  table.key("kind", effect.kind).some("U", effect.U).some("center", effect.center);
  table.all(effect.numbers).all(effect.vectors).some("on", effect.on);
  std::vector<std::vector<std::string>> pairs;
  for (const auto& [a, b] : effect.between) pairs.push_back({a, b});
  tables_ += table.some("between", pairs).text();
  return *this;
}

void Scene::become(core::Scene changed) {
  constants_.clear();
  observables_.clear();
  tables_.clear();
  head_ = core::write_scene(changed);
  read_ = std::make_shared<core::Scene>(std::move(changed));
}

Scene& Scene::set(const std::string& what, const Number& value) {
  become(core::with_number(core::scene_of(*this), what, core::expression_of(value, what + ":")));
  return *this;
}

Scene& Scene::observe(const std::string& quantity) {
  take_apart();
  observables_.push_back(quantity);
  return *this;
}

Scene& Scene::observe(const std::string& name, const std::string& formula) {
  become(core::with_observation(core::scene_of(*this), name, formula));
  return *this;
}

Scene& Scene::event(const std::string& text) {
  become(core::with_event(core::scene_of(*this), text));
  return *this;
}

std::string Scene::toml() const {
  std::string text = head_;
  if (!observables_.empty()) text += "observables = " + hbvm::toml(observables_) + "\n";
  if (!constants_.empty()) {
    text += "\n[constants]\n";
    for (const std::string& line : constants_) text += line + "\n";
  }
  return text + tables_;
}

void Scene::check() const {
  const core::Scene scene = core::scene_of(*this);
  // So many digits that no number of a scene is lost.
  constexpr int digits = 50;
  const core::PrecisionScope scope(digits);
  core::assemble<core::Mpfr>(scene);
}

Scene read_scene(const std::string& toml, const std::string& name) {
  Scene scene;
  scene.name_ = name;
  scene.head_ = toml;
  scene.read_ = std::make_shared<const core::Scene>(core::read_scene(toml, name));
  return scene;
}

Scene load_scene(const std::string& path_or_name) {
  // The text as it is, so that messages name its lines.
  return read_scene(core::scene_text(path_or_name), path_or_name);
}

const std::string& scene_template() { return core::new_scene(); }

Scene project(const Scene& scene, const std::string& precision, const std::vector<std::string>& hold) {
  const core::Scene from = core::scene_of(scene);
  const std::vector<core::HeldPart> held = core::held_parts(from, hold);
  return core::with_scalar(core::Precision::parse(precision), [&]<core::Scalar S>() {
    Scene projected = read_scene(core::with_start(scene.toml(), core::project<S>(from, held)), scene.name());
    core::assemble<S>(core::scene_of(projected));  // what is written must be accepted
    return projected;
  });
}

namespace core {

Scene scene_of(const hbvm::Scene& scene) { return scene.read_ ? *scene.read_ : read_scene(scene.toml(), scene.name()); }

}  // namespace core

}  // namespace hbvm
