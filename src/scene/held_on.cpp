#include "scene/held_on.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>

#include "problem/effect/execution.hpp"
#include "problem/formula/input.hpp"
#include "scalar/literal.hpp"
#include "scene/formula_binding.hpp"
#include "scene/level_lines.hpp"
#include "scene/moving_point.hpp"
#include "scene/traced_curve.hpp"

namespace hbvm::core {
namespace {

/// A surface that moves is not drawn.
bool is_about(const SceneConstraint& c, const SceneBody& body, const Constants& constants) {
  if (c.formula && names_time(c.formula->expression, constants)) return false;
  if (c.formula) return c.formula->of == std::vector<std::string>{body.name};
  return c.pairs.empty() && c.bodies.size() == 1 && c.bodies.begin()->second == body.name && c.has("body") &&
         (c.kind == "plane" || c.kind == "quadric");
}

/// A body alone, as FormulaBinding asks for it.
struct LoneBody {
  const Scene& scene;
  const SceneBody& body;

  Displacement<double> position(const std::string&) const { return {{{0, 1}}, {}}; }
  Displacement<double> difference(const std::string&, const std::string&) const { return {}; }
  Displacement<double> time() const { return {}; }
  double mass(const std::string&) const { return evaluate<double>(*body.mass, scene.constants); }
  double charge(const std::string&) const { return evaluate<double>(*body.charge, scene.constants); }
};

LevelFunction function_of(const Scene& scene, const SceneFormula& formula, const SceneBody& body) {
  const FormulaBinding<double> binding(formula, scene.dimension, scene.constants);
  FormulaInput<double> input = binding.input();
  input.instances.push_back(binding.instance(formula.of, LoneBody{scene, body}));
  const auto term = std::make_shared<const EffectTerm<double>>(make_term(input));
  return [term](const Matrix<double>& points) -> Vector<double> {
    Matrix<double> coefficients(points.rows(), term->value_coefficients.cols());
    for (Index i = 0; i < points.rows(); ++i) coefficients.row(i) = term->value_coefficients.row(0);
    return outputs_of(term->value, coefficients, points);
  };
}

/// x^T A x + b^T x + c.
LevelFunction function_of(const Scene& scene, const SceneConstraint& constraint) {
  const Index d = scene.dimension;
  const auto number = [&](const Expression& e) { return evaluate<double>(e, scene.constants); };
  const auto vector = [&](const SceneVector& v) {
    Vector<double> result(d);
    for (Index i = 0; i < d; ++i) result[i] = number(v[static_cast<std::size_t>(i)]);
    return result;
  };
  Matrix<double> A = Matrix<double>::Zero(d, d);
  if (const auto found = constraint.matrices.find("A"); found != constraint.matrices.end())
    for (Index i = 0; i < d; ++i) A.row(i) = vector(found->second[static_cast<std::size_t>(i)]).transpose();
  const bool plane = constraint.kind == "plane";
  const Vector<double> b = vector(constraint.vectors.find(plane ? "normal" : "b")->second);
  const double c =
      plane ? -number(constraint.numbers.find("offset")->second) : number(constraint.numbers.find("c")->second);
  return [A, b, c](const Matrix<double>& points) -> Vector<double> {
    Vector<double> result(points.rows());
    for (Index i = 0; i < points.rows(); ++i) {
      const Vector<double> x = points.row(i).transpose();
      result[i] = x.dot(A * x) + b.dot(x) + c;
    }
    return result;
  };
}

/// What tells one set of constraints from another.
std::string text_of(const SceneConstraint& c, const SceneBody& body) {
  std::string text = c.kind;
  if (c.formula)
    text += c.formula->expression.text() + " of " + (body.mass ? body.mass->text() : "") + "," +
            (body.charge ? body.charge->text() : "");
  const auto add = [&](const SceneVector& v) {
    for (const Expression& e : v) text += " " + e.text();
  };
  for (const auto& [key, number] : c.numbers) text += " " + key + number.text();
  for (const auto& [key, v] : c.vectors) add(v);
  for (const auto& [key, rows] : c.matrices)
    for (const SceneVector& row : rows) add(row);
  return text;
}

/// Bodies held alike, and where they are.
struct HeldBodies {
  std::vector<LevelFunction> g;
  std::array<double, 3> start{};
  SpaceBox box;
};

void widen_to(SpaceBox& box, const std::array<double, 3>& x) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (!std::isfinite(x[i])) continue;
    box.low[i] = std::min(box.low[i], x[i]);
    box.high[i] = std::max(box.high[i], x[i]);
  }
}

/// Some of what is beside the motion is seen as well. \param share of the lengths that comes to them
SpaceBox widened_for_lines(SpaceBox box, std::size_t dimension, double share) {
  const double least = box.longest() / 4;
  for (std::size_t i = 0; i < dimension; ++i) {
    const double middle = (box.low[i] + box.high[i]) / 2, half = std::max(box.length(i) / 2, least) * (1 + share);
    box.low[i] = middle - half;
    box.high[i] = middle + half;
  }
  return box;
}

}  // namespace

std::vector<LevelFunction> holding(const Scene& scene, const SceneBody& body) {
  std::vector<LevelFunction> result;
  for (const SceneConstraint& c : scene.constraints)
    if (is_about(c, body, scene.constants))
      result.push_back(c.formula ? function_of(scene, *c.formula, body) : function_of(scene, c));
  return result;
}

HeldOn held_on(const Scene& scene, const std::vector<std::vector<double>>& states) {
  const auto d = static_cast<std::size_t>(scene.dimension);
  std::map<std::string, HeldBodies> held;
  for (std::size_t n = 0; n < scene.bodies.size(); ++n) {
    const SceneBody& body = scene.bodies[n];
    std::string text;
    for (const SceneConstraint& c : scene.constraints)
      if (is_about(c, body, scene.constants)) text += text_of(c, body) + "\n";
    if (text.empty()) continue;
    const auto at = [&](const std::vector<double>& q) {
      std::array<double, 3> x{};
      std::copy_n(q.begin() + static_cast<std::ptrdiff_t>(n * d), d, x.begin());
      return x;
    };
    HeldBodies& bodies = held[text];
    if (bodies.g.empty()) bodies = {holding(scene, body), at(states.front()), {at(states.front()), at(states.front())}};
    for (const std::vector<double>& q : states) widen_to(bodies.box, at(q));
  }
  HeldOn lines;
  for (auto& [text, bodies] : held) {
    // Of a state alone, what is between its bodies and the origin, and as much on the other side.
    if (!(bodies.box.longest() > 0))
      for (const double side : {-1, 1})
        for (std::size_t i = 0; i < d; ++i) {
          const auto& [x, y, z] = bodies.start;
          const double size = std::max({std::abs(x), std::abs(y), std::abs(z)});
          std::array<double, 3> corner = bodies.start;
          corner[i] = side * (size > 0 ? size : 1);
          widen_to(bodies.box, corner);
        }
    constexpr double beside_mesh = 1 / double{5}, beside_curve = 3 / double{5};
    if (bodies.g.size() + 1 == d)
      lines.curves.push_back(
          traced_curve(bodies.g, bodies.start, widened_for_lines(bodies.box, d, beside_curve), scene.dimension));
    else if (d == 3 && bodies.g.size() == 1)
      for (PointLine& line : level_lines(bodies.g.front(), widened_for_lines(bodies.box, d, beside_mesh)))
        lines.meshes.push_back(std::move(line));
  }
  std::erase_if(lines.curves, [](const PointLine& line) { return line.size() < 2; });
  return lines;
}

}  // namespace hbvm::core
