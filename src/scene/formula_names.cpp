#include "scene/formula_names.hpp"

#include <functional>

#include "nearest.hpp"
#include "scalar/expression_node.hpp"

namespace hbvm::core {
namespace {

constexpr std::string_view axes = "xyz";

/// Calls f for every name, where it stands.
void for_each_name(const Expression::Node& node, const std::function<void(const Expression::Node&)>& f) {
  if (node.kind == Expression::Node::Kind::name) f(node);
  if (node.left) for_each_name(*node.left, f);
  if (node.right) for_each_name(*node.right, f);
}

/// x y z m Q of one place, each as `named` makes it.
void add_place(FormulaNames& names, std::size_t place, int dimension,
               const std::function<std::string(std::string_view)>& named) {
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(dimension); ++axis)
    names[named(axes.substr(axis, 1))] = {FormulaName::Is::coordinate, place, axis};
  names[named("m")] = {FormulaName::Is::mass, place};
  names[named("Q")] = {FormulaName::Is::charge, place};
}

}  // namespace

std::string TextBegin::place(std::string_view text, std::size_t at) const {
  std::size_t here_line = line, here_column = (column > 0 ? column : 1) + at;
  for (std::size_t i = 0; i < at && i < text.size(); ++i) {
    if (text[i] != '\n') continue;
    ++here_line;
    here_column = at - i;
  }
  if (column == 0) return "column " + std::to_string(here_column) + " of the formula";
  return "line " + std::to_string(here_line) + ", column " + std::to_string(here_column);
}

FormulaNames force_names(const std::vector<std::string>& of, bool local, int dimension) {
  FormulaNames names;
  names["t"] = {FormulaName::Is::time};
  if (!local) return names;
  const auto add_velocity = [&](std::size_t place, const std::string& prefix) {
    for (std::size_t axis = 0; axis < static_cast<std::size_t>(dimension); ++axis)
      names[prefix + "v" + std::string(axes.substr(axis, 1))] = {FormulaName::Is::velocity, place, axis};
  };
  if (of.empty()) {
    add_place(names, 0, dimension, [](std::string_view name) { return std::string(name); });
    add_velocity(0, "");
  }
  for (std::size_t i = 0; i < of.size(); ++i) {
    add_place(names, i, dimension, [&](std::string_view name) { return of[i] + "." + std::string(name); });
    add_velocity(i, of[i] + ".");
  }
  return names;
}

FormulaNames formula_names(const SceneFormula& formula, int dimension) {
  FormulaNames names;
  names["t"] = {FormulaName::Is::time};
  const auto plain = [](std::string_view name) { return std::string(name); };
  if (formula.acts == Acts::on_each_body || formula.acts == Acts::about_a_center) {
    add_place(names, 0, dimension, plain);
    if (formula.acts == Acts::about_a_center) names["r"] = {FormulaName::Is::distance};
    return names;
  }
  const bool pair = formula.acts == Acts::between_pairs;
  for (std::size_t i = 0; i < (pair ? 2 : formula.of.size()); ++i) {
    const std::string number = std::to_string(i + 1);
    add_place(names, i, dimension, [&](std::string_view name) { return std::string(name) + number; });
    if (!pair)
      add_place(names, i, dimension, [&](std::string_view name) { return formula.of[i] + "." + std::string(name); });
  }
  if (!pair) return names;
  names["r"] = {FormulaName::Is::distance};
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(dimension); ++axis)
    names[std::string(axes.substr(axis, 1))] = {FormulaName::Is::difference, 0, axis};
  return names;
}

FormulaNames names_used(const SceneFormula& formula, int dimension, const Constants& constants) {
  return names_used(formula.expression, formula_names(formula, dimension), constants);
}

FormulaNames names_used(const Expression& expression, FormulaNames known, const Constants& constants) {
  if (constants.contains("t")) known.erase("t");
  FormulaNames used;
  for_each_name(*expression.root(), [&](const Expression::Node& node) {
    const auto found = known.find(node.text);
    const bool constant = constants.contains(node.text);
    const auto fail = [&](const std::string& reason) { throw ExpressionError(expression.text(), node.at, reason); };
    if (found != known.end() && constant)
      fail("'" + node.text + "' is a constant of the scene, and something of the bodies here: rename the constant");
    if (found != known.end()) {
      used.insert(*found);
    } else if (!constant) {
      std::vector<std::string> candidates;
      for (const auto& [name, unused] : known) candidates.push_back(name);
      for (const auto& [name, unused] : constants) candidates.push_back(name);
      fail("unknown name '" + node.text + "'" + did_you_mean(node.text, candidates));
    }
  });
  return used;
}

}  // namespace hbvm::core
