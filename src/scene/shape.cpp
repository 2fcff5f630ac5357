#include "scene/shape.hpp"

#include <algorithm>

#include "scalar/literal.hpp"

namespace hbvm::core {
namespace {

/// A key of `shape`, and how many numbers stand there; 1 is a number and no array.
struct ShapeKind {
  const char* name;
  std::size_t numbers;
  bool in_plane, has_axis;
};

std::vector<ShapeKind> kinds_of_shape(std::size_t dimension) {
  return {{"box", dimension, true, false},
          {"cylinder", 2, false, true},
          {"disc", 1, true, true},
          {"ring", 1, true, true},
          {"sphere", 1, false, false}};
}

bool all(const SceneVector& v, const Constants& constants, const auto& holds) {
  return std::all_of(v.begin(), v.end(), [&](const Expression& e) { return holds(evaluate<double>(e, constants)); });
}

}  // namespace

SceneShape read_shape(TomlTable& body, std::size_t dimension, const Constants& constants) {
  const toml::node& node = body.require("shape");
  const toml::table* const table = node.as_table();
  std::vector<std::string> known;
  for (const ShapeKind& kind : kinds_of_shape(dimension))
    if (dimension == 3 || kind.in_plane) known.emplace_back(kind.name);
  std::string list;
  for (const std::string& name : known)
    list += (list.empty() ? "'" : name == known.back() ? " or '" : ", '") + name + "'";
  if (!table) body.fail(node, "'shape' must be a table with one of " + list + ", as { disc = 0.3 }");
  TomlTable reader(body.source(), *table, body.what() + ", shape");
  SceneShape shape;
  for (const ShapeKind& kind : kinds_of_shape(dimension)) {
    if (!reader.has(kind.name)) continue;
    if (!shape.kind.empty()) reader.fail("give '" + shape.kind + "' or '" + kind.name + "', not both");
    shape.kind = kind.name;
    if (dimension == 2 && !kind.in_plane)
      reader.fail("there is no '" + shape.kind + "' in the plane: give one of " + list);
    if (kind.numbers == 1)
      shape.sizes = {reader.number(kind.name)};
    else
      shape.sizes = reader.vector(kind.name, kind.numbers);
    if (!all(shape.sizes, constants, [](double x) { return x > 0; }))
      reader.fail(*reader.take(kind.name), "'" + shape.kind + "' must be positive");
    if (dimension == 2 || !kind.has_axis || !reader.take("axis")) continue;
    shape.axis = reader.vector("axis", dimension);
    if (all(shape.axis, constants, [](double x) { return x == 0; }))
      reader.fail(*reader.take("axis"), "'axis' must not be 0");
  }
  if (reader.take("at")) shape.at = reader.vector("at", dimension);
  for (const std::string& name : known) reader.take(name);
  reader.finish();
  if (shape.kind.empty()) reader.fail("one of " + list + " is missing");
  return shape;
}

}  // namespace hbvm::core
