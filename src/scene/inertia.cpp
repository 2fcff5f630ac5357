#include "scene/inertia.hpp"

namespace hbvm::core {
namespace {

std::string bracketed(const Expression& e) { return "(" + e.text() + ")"; }

}  // namespace

SceneMatrix second_moment_of(const SceneMatrix& inertia, const Expression& mass, const SceneVector& center) {
  const std::size_t d = center.size();
  std::string trace;
  for (std::size_t i = 0; i < inertia.size(); ++i) trace += (i > 0 ? " + " : "") + bracketed(inertia[i][i]);
  SceneMatrix result;
  for (std::size_t i = 0; i < d; ++i) {
    result.emplace_back();
    for (std::size_t j = 0; j < d; ++j) {
      std::string entry = bracketed(mass) + "*" + bracketed(center[i]) + "*" + bracketed(center[j]);
      if (i == j) entry += " + (" + trace + ")/2";
      if (d == 3) entry += " - " + bracketed(inertia[i][j]);
      result.back().push_back(Expression::parse(entry));
    }
  }
  return result;
}

SceneMatrix read_inertia(TomlTable& body, std::size_t dimension) {
  if (dimension == 2) return {{body.number("inertia")}};
  const toml::node& node = body.require("inertia");
  const toml::array* const entries = node.as_array();
  if (entries && !entries->empty() && entries->front().is_array()) return body.matrix("inertia", dimension);
  const SceneVector moments = body.to_vector(node, dimension, "'inertia'");
  const Expression none = Expression::parse("0");
  SceneMatrix result(dimension, SceneVector(dimension, none));
  for (std::size_t i = 0; i < dimension; ++i) result[i][i] = moments[i];
  return result;
}

}  // namespace hbvm::core
