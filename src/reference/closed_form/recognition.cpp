#include "reference/closed_form/recognition.hpp"

#include <variant>

#include "problem/effect/execution.hpp"

namespace hbvm::core {

Vector<Mpfr> cross(const Vector<Mpfr>& a, const Vector<Mpfr>& b) {
  Vector<Mpfr> c(3);
  for (Index j = 0; j < 3; ++j) c[j] = a[(j + 1) % 3] * b[(j + 2) % 3] - a[(j + 2) % 3] * b[(j + 1) % 3];
  return c;
}

Matrix<Mpfr> multiplied(const Matrix<Mpfr>& a, const Matrix<Mpfr>& b) {
  Matrix<Mpfr> c = Matrix<Mpfr>::Zero(a.rows(), b.cols());
  for (Index j = 0; j < b.cols(); ++j)
    for (Index l = 0; l < a.cols(); ++l)
      for (Index i = 0; i < a.rows(); ++i) c(i, j) += a(i, l) * b(l, j);
  return c;
}

Vector<Mpfr> Acting::gradient(const Vector<Mpfr>& x) const {
  return outputs_of<Mpfr>(term->gradient, term->gradient_coefficients.row(instance), x.transpose()).transpose();
}

Matrix<Mpfr> Acting::hessian(const Vector<Mpfr>& x) const {
  const Matrix<Mpfr> lower = outputs_of<Mpfr>(term->hessian, term->hessian_coefficients.row(instance), x.transpose());
  Matrix<Mpfr> result(x.size(), x.size());
  for (Index i = 0, k = 0; i < x.size(); ++i)
    for (Index j = 0; j <= i; ++j, ++k) result(i, j) = result(j, i) = lower(0, k);
  return result;
}

Recognition::Recognition(const Assembled<Mpfr>& assembled, const Mpfr& epsilon_of_scene)
    : scene(assembled), round_off(epsilon_of_scene), dimension(assembled.problem.dimension) {
  for (const EffectTerm<Mpfr>& term : scene.problem.potential.terms)
    for (Index i = 0; i < term.instances(); ++i)
      if (term.symmetry.acts[static_cast<std::size_t>(i)]) acting.push_back({&term, i});
}

std::optional<Mpfr> Recognition::mass_at(Index offset) const {
  for (const auto& block : scene.problem.mass.blocks()) {
    if (offset < block.offset || offset >= block.offset + block.size) continue;
    if (!block.full) return Mpfr(block.mass);
    if (block.offset != offset || block.size != dimension) return std::nullopt;
    for (Index i = 0; i < block.size; ++i)
      for (Index j = 0; j < block.size; ++j)
        if (block.M(i, j) != (i == j ? block.M(0, 0) : Mpfr(0))) return std::nullopt;
    return Mpfr(block.M(0, 0));
  }
  return std::nullopt;
}

bool Recognition::is_constant_force() const {
  for (const Acting& a : acting)
    if (!a.term->constant_force) return false;
  return true;
}

Vector<Mpfr> Recognition::constant_force() const {
  Vector<Mpfr> force = Vector<Mpfr>::Zero(scene.problem.m());
  for (const Acting& a : acting) {
    const Vector<Mpfr> gradient = a.gradient(Vector<Mpfr>::Zero(a.term->arguments * dimension));
    a.for_each_coordinate(dimension, [&](Index i, Index at, const Mpfr& weight) { force[at] += weight * gradient[i]; });
  }
  return force;
}

std::optional<OnSphere> Recognition::on_sphere() const {
  const Problem<Mpfr>& problem = scene.problem;
  if (dimension == 1 || problem.m() != dimension || problem.nu() != 1 || !is_constant_force()) return std::nullopt;
  const std::optional<Mpfr> mass = mass_at(0);
  if (!mass) return std::nullopt;
  const ConstraintForms<Mpfr>& form = problem.constraints.front().form;
  OnSphere sphere{*mass, Mpfr(0), Vector<Mpfr>::Zero(dimension)};
  if (const auto* rod = std::get_if<Rod<Mpfr>>(&form)) {
    if (rod->x.blocks.size() != 1) return std::nullopt;
    const Mpfr weight = rod->x.blocks.front().weight;
    if (rod->x.shift.size() > 0)
      for (Index j = 0; j < dimension; ++j) sphere.pivot[j] = -rod->x.shift[j] / weight;
    sphere.radius = sqrt(rod->square) / magnitude(weight);
    return sphere;
  }
  if (const auto* quadric = std::get_if<Quadric<Mpfr>>(&form)) {
    const Mpfr a = quadric->A(0, 0);
    for (Index i = 0; i < dimension; ++i)
      for (Index j = 0; j < dimension; ++j)
        if (quadric->A(i, j) != (i == j ? a : Mpfr(0))) return std::nullopt;
    for (Index j = 0; j < dimension; ++j) sphere.pivot[j] = -quadric->b[j] / (2 * a);
    sphere.radius = sqrt(Mpfr(inner(sphere.pivot, sphere.pivot) - quadric->c / a));
    return sphere;
  }
  return std::nullopt;
}

}  // namespace hbvm::core
