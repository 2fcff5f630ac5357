#pragma once

#include "linear/lu.hpp"
#include "problem/problem.hpp"
#include "scalar/random_values.hpp"

namespace hbvm::core {

/// Dense and slow counterparts of what problem/ stores by blocks and patterns.

template <Scalar S>
Vector<S> dense_constraints(const Problem<S>& problem, const Vector<S>& q) {
  Vector<S> g(problem.nu());
  for (Index a = 0; a < problem.nu(); ++a)
    g[a] = value(problem.constraints[static_cast<std::size_t>(a)], problem.dimension, q).g;
  return g;
}

/// grad g, m x nu: central differences, which are exact for quadratic g whatever the step.
template <Scalar S>
Matrix<S> dense_gradient(const Problem<S>& problem, const Vector<S>& q) {
  Matrix<S> G(problem.m(), problem.nu());
  for (Index i = 0; i < problem.m(); ++i) {
    Vector<S> before = q, after = q;
    before[i] -= 1;
    after[i] += 1;
    G.row(i) = (dense_constraints(problem, after) - dense_constraints(problem, before)).transpose() / S(2);
  }
  return G;
}

/// (nabla^2 g)(v, v) of each constraint, by second differences, exact as well.
template <Scalar S>
Vector<S> dense_curvature(const Problem<S>& problem, const Vector<S>& q, const Vector<S>& v) {
  return dense_constraints<S>(problem, q + v) + dense_constraints<S>(problem, q - v) -
         S(2) * dense_constraints<S>(problem, q);
}

template <Scalar S>
Matrix<S> dense_mass(const MassMatrix<S>& mass) {
  Matrix<S> M = Matrix<S>::Zero(mass.m(), mass.m());
  for (const auto& block : mass.blocks())
    for (Index i = 0; i < block.size; ++i)
      for (Index j = 0; j < block.size; ++j)
        M(block.offset + i, block.offset + j) = block.full ? block.M(i, j) : S(i == j ? block.mass : S(0));
  return M;
}

template <Scalar S>
Matrix<S> dense_inverse(const Matrix<S>& a) {
  Lu<S> lu;
  lu.set(a);
  if (!lu.factor()) return {};
  Matrix<S> inverse(a.rows(), a.cols());
  for (Index j = 0; j < a.cols(); ++j) {
    Vector<S> column = Vector<S>::Unit(a.rows(), j);
    lu.solve(column);
    inverse.col(j) = column;
  }
  return inverse;
}

template <Scalar S>
Vector<S> times(const Matrix<S>& a, const Vector<S>& x) {
  return a.lazyProduct(x);
}

/// Symmetric and positive definite, with entries that are whole numbers over 8.
template <Scalar S>
Matrix<S> mass_block(Index n) {
  Matrix<S> M(n, n);
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j) M(i, j) = i == j ? S(2 + i) : S(1 + i + j) / 8;
  return M;
}

/// Bodies of these masses in d dimensions, under nothing.
template <Scalar S>
Problem<S> free_bodies(Index d, const std::vector<S>& masses) {
  Problem<S> problem;
  problem.dimension = problem.potential.dimension = d;
  for (const S& mass : masses) {
    problem.blocks.push_back({problem.m(), true});
    problem.mass.add_scalar(d, mass);
  }
  problem.potential.m = problem.m();
  return problem;
}

/// Bodies 0 (mass 2), 1 (full block), 2 (mass 1) and 3 (mass 3/4) with one constraint of every form, some of them
/// sharing bodies.
template <Scalar S>
Problem<S> constrained_problem(Index d) {
  Problem<S> problem;
  problem.dimension = problem.potential.dimension = d;
  problem.mass.add_scalar(d, S(2));
  problem.mass.add_full(mass_block<S>(d));
  problem.mass.add_scalar(d, S(1));
  problem.mass.add_scalar(d, S(3) / 4);
  problem.potential.m = problem.m();

  const auto difference = [&](Index a, Index b) { return Displacement<S>{{{a * d, S(1)}, {b * d, S(-1)}}, {}}; };
  const auto rod = [&](const char* name, const Displacement<S>& x, const S& square) {
    problem.constraints.push_back({name, Rod<S>{x, square}});
  };
  Displacement<S> to_point{{{0, S(1)}}, Vector<S>(d)};
  for (Index j = 0; j < d; ++j) to_point.shift[j] = S(j + 1) / 4;
  rod("pin", to_point, S(2));
  rod("rod", difference(0, 1), S(9) / 4);
  problem.constraints.push_back({"angle", DisplacementProduct<S>{difference(0, 1), difference(2, 1), S(1) / 2}});
  Vector<S> linear(d), normal(d);
  for (Index j = 0; j < d; ++j) {
    linear[j] = S(2 * j - 1) / 2;
    normal[j] = S(j + 2);
  }
  Matrix<S> A = mass_block<S>(d);
  A(0, 0) = -1;
  A(0, 1) = A(1, 0) = 0;
  problem.constraints.push_back({"quadric", Quadric<S>{{d}, A, linear, S(-3)}});
  problem.constraints.push_back({"sphere", Quadric<S>{{3 * d}, Matrix<S>::Identity(d, d), Vector<S>::Zero(d), S(-1)}});
  problem.constraints.push_back({"plane", Plane<S>{{2 * d}, normal, S(5) / 2}});
  rod("between centres", Displacement<S>{{{0, S(1) / 2}, {3 * d, S(1) / 2}, {2 * d, S(-1)}}, {}}, S(1));
  return problem;
}

}  // namespace hbvm::core
