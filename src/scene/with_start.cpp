#include "scene/with_start.hpp"

#include <algorithm>

#include "toml/toml_table.hpp"

namespace hbvm::core {
namespace {

/// What stands between two places of a text, and what is to stand there.
struct Replacement {
  std::size_t begin, end;
  std::string text;
};

class StartEditor {
 public:
  explicit StartEditor(const TomlSource& source) : source_(source) {}

  /// An entry, which may be a number or an expression in quotes; one that says the same already is left alone.
  void replace(const toml::node& node, const Expression& value) {
    const std::size_t begin = source_.offset_of(node.source().begin), end = source_.offset_of(node.source().end);
    const std::string text = "\"" + value.text() + "\"";
    const std::string there = source_.text().substr(begin, end - begin);
    if (there != text && there != value.text()) replacements_.push_back({begin, end, text});
  }

  void replace(const toml::node& node, const SceneVector& values) {
    const toml::array* const entries = node.as_array();
    if (entries && entries->size() == values.size())
      for (std::size_t i = 0; i < values.size(); ++i) replace((*entries)[i], values[i]);
    else if (values.size() == 1)
      replace(node, values.front());
  }

  void replace(const toml::node& node, const SceneMatrix& rows) {
    const toml::array* const entries = node.as_array();
    if (!entries || entries->size() != rows.size()) return;
    for (std::size_t i = 0; i < rows.size(); ++i) replace((*entries)[i], rows[i]);
  }

  /// An orientation: the angles are replaced by the directors, unless they are those already.
  void turn(const toml::table& table, const SceneMatrix& now, const SceneMatrix& before) {
    const toml::node* const node = table.get("orientation");
    if (!node || texts_of(now) == texts_of(before)) return;
    const std::size_t begin = source_.offset_of(node->source().begin), end = source_.offset_of(node->source().end);
    replacements_.push_back({begin, end, "{ directors = " + texts_of(now) + " }"});
  }

  template <class Values>
  void replace(const toml::table& table, std::string_view key, const Values& values) {
    if (const toml::node* const node = table.get(key)) replace(*node, values);
  }

  /// From the last to the first, so that no replacement moves another.
  std::string edited() {
    std::sort(replacements_.begin(), replacements_.end(),
              [](const Replacement& a, const Replacement& b) { return a.begin > b.begin; });
    std::string text = source_.text();
    for (const Replacement& r : replacements_) text.replace(r.begin, r.end - r.begin, r.text);
    return text;
  }

 private:
  static std::string texts_of(const SceneMatrix& rows) {
    std::string text;
    for (const SceneVector& row : rows) {
      std::string entries;
      for (const Expression& e : row) entries += (entries.empty() ? "\"" : ", \"") + e.text() + "\"";
      text += (text.empty() ? "[" : ", [") + entries + "]";
    }
    return "[" + text + "]";
  }

  const TomlSource& source_;
  std::vector<Replacement> replacements_;
};

}  // namespace

std::string with_start(const std::string& toml, const Scene& start) {
  const TomlSource source(toml, start.name);
  const toml::table root = source.parse();
  TomlTable top(source, root, "scene");
  StartEditor editor(source);
  const auto bodies = top.tables("body");
  for (std::size_t i = 0; i < std::min(bodies.size(), start.bodies.size()); ++i) {
    editor.replace(*bodies[i], "position", start.bodies[i].position);
    editor.replace(*bodies[i], "velocity", start.bodies[i].velocity);
    editor.replace(*bodies[i], "momentum", start.bodies[i].momentum);
  }
  const auto rigid = top.tables("rigid_body");
  const Scene before = rigid.empty() ? Scene() : read_scene(toml, start.name);
  for (std::size_t i = 0; i < std::min(rigid.size(), start.rigid_bodies.size()); ++i) {
    const SceneRigidBody& body = start.rigid_bodies[i];
    editor.replace(*rigid[i], "position", body.position);
    editor.replace(*rigid[i], "velocity", body.velocity);
    editor.replace(*rigid[i], "directors", body.directors);
    editor.turn(*rigid[i], body.directors, before.rigid_bodies[i].directors);
    editor.replace(*rigid[i], "angular_velocity", body.angular_velocity);
  }
  return editor.edited();
}

}  // namespace hbvm::core
