#include "hbvm/problem/regularity.hpp"

#include <Eigen/Eigenvalues>
#include <limits>

#include "hbvm/linear/lu.hpp"
#include "hbvm/problem/constraint_gradient.hpp"

namespace hbvm {
namespace {

/// grad g at q, dense: m x nu.
template <Scalar S>
Matrix<S> dense_gradient(ConstraintGradient<S>& gradient, const Problem<S>& problem) {
  const Index m = problem.m(), nu = problem.nu();
  Matrix<S> G(m, nu);
  Matrix<S> unit = Matrix<S>::Zero(1, nu);
  for (Index a = 0; a < nu; ++a) {
    Vector<S> column = Vector<S>::Zero(m);
    unit(0, a) = 1;
    gradient.add_times(unit, lanes(column));
    unit(0, a) = 0;
    G.col(a) = column;
  }
  return G;
}

/// Of a symmetric matrix, in double.
template <Scalar S>
double largest_eigenvalue(const Matrix<S>& a) {
  const Matrix<double> rounded = a.unaryExpr([](const S& x) { return approximately(x); });
  return Eigen::SelfAdjointEigenSolver<Matrix<double>>(rounded, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
}

template <Scalar S>
Matrix<S> gram_matrix(const Problem<S>& problem, const Vector<S>& q) {
  ConstraintGradient<S> gradient(problem, 1);
  gradient.update(lanes(q));
  Matrix<S> gram;
  gradient.gram(gram);
  return gram;
}

/// Of a symmetric matrix.
template <Scalar S>
double condition(const Matrix<S>& a) {
  const double largest = largest_eigenvalue(a);
  Lu<S> lu;
  lu.set(a);
  if (!lu.factor()) return std::numeric_limits<double>::infinity();
  // The smallest one may be lost in double, but not the largest one of the inverse.
  Matrix<S> inverse(a.rows(), a.rows());
  for (Index j = 0; j < a.rows(); ++j) {
    Vector<S> column = Vector<S>::Unit(a.rows(), j);
    lu.solve(column);
    inverse.col(j) = column;
  }
  return largest * largest_eigenvalue(inverse);
}

}  // namespace

template <Scalar S>
std::optional<Dependence> find_dependence(const Problem<S>& problem, const Vector<S>& q) {
  const Index m = problem.m(), nu = problem.nu();
  if (nu == 0) return std::nullopt;
  ConstraintGradient<S> gradient(problem, 1);
  gradient.update(lanes(q));
  const Matrix<S> G = dense_gradient(gradient, problem);
  const int digits = digits10<S>();
  const S working_epsilon = epsilon<S>();
  const PrecisionScope guarded(static_cast<unsigned>(2 * digits + 20));
  const auto exact = [](const S& x) { return rounded_to<Mpfr>(raw(exactly(x))); };
  // Gram-Schmidt in the metric M^-1 as Cholesky's method. W G is formed exactly enough from the exact G and W.
  Matrix<Mpfr> exact_G(m, nu), weighted(m, nu);
  for (Index i = 0; i < G.size(); ++i) exact_G.data()[i] = exact(G.data()[i]);
  for (const auto& block : problem.mass.blocks()) {
    for (Index j = 0; j < block.size; ++j) {
      for (Index a = 0; a < nu; ++a) {
        Mpfr sum = 0;
        if (block.full)
          for (Index l = 0; l < block.size; ++l) sum += exact(block.W(j, l)) * exact_G(block.offset + l, a);
        else
          sum = exact(block.inverse_mass) * exact_G(block.offset + j, a);
        weighted(block.offset + j, a) = sum;
      }
    }
  }
  // A gradient's direction is known to a few roundings of its entries, and the pivots are squares.
  Mpfr tolerance = Mpfr(static_cast<long>(64 * m)) * exact(working_epsilon);
  tolerance *= tolerance;
  Matrix<Mpfr> L = Matrix<Mpfr>::Zero(nu, nu);
  for (Index a = 0; a < nu; ++a) {
    const auto gram = [&](Index b, Index c) {
      Mpfr sum = 0;
      for (Index i = 0; i < m; ++i)
        if (exact_G(i, b) != 0) sum += exact_G(i, b) * weighted(i, c);
      return sum;
    };
    for (Index b = 0; b < a; ++b) {
      Mpfr sum = gram(b, a);
      for (Index c = 0; c < b; ++c)
        if (L(a, c) != 0 && L(b, c) != 0) sum -= L(a, c) * L(b, c);
      L(a, b) = sum / L(b, b);
    }
    const Mpfr size = gram(a, a);
    Mpfr pivot = size;
    for (Index c = 0; c < a; ++c) pivot -= L(a, c) * L(a, c);
    if (!(pivot > tolerance * size)) {
      // grad g_a = sum_b x_b grad g_b with L^T x = (row a of L), L that of the constraints before a.
      Dependence found{a, {}};
      Vector<Mpfr> x(a);
      for (Index b = a - 1; b >= 0; --b) {
        Mpfr sum = L(a, b);
        for (Index c = b + 1; c < a; ++c) sum -= L(c, b) * x[c];
        x[b] = sum / L(b, b);
      }
      for (Index b = 0; b < a; ++b)
        if (x[b] * x[b] * gram(b, b) > tolerance * size) found.others.push_back(b);
      return found;
    }
    L(a, a) = sqrt(pivot);
  }
  return std::nullopt;
}

template <Scalar S>
double gram_condition(const Problem<S>& problem, const Vector<S>& q) {
  return problem.nu() == 0 ? 1 : condition(gram_matrix(problem, q));
}

template <Scalar S>
double angle_condition(const Problem<S>& problem, const Vector<S>& q) {
  using std::sqrt;
  const Index nu = problem.nu();
  if (nu == 0) return 1;
  Matrix<S> gram = gram_matrix(problem, q);
  Vector<S> length(nu);
  for (Index a = 0; a < nu; ++a) length[a] = sqrt(gram(a, a));
  for (Index b = 0; b < nu; ++b)
    for (Index a = 0; a < nu; ++a) gram(a, b) = a == b ? S(1) : S(gram(a, b) / (length[a] * length[b]));
  return condition(gram);
}

#define HBVM_DEFINE(S)                                                                        \
  template std::optional<Dependence> find_dependence<S>(const Problem<S>&, const Vector<S>&); \
  template double gram_condition<S>(const Problem<S>&, const Vector<S>&);                     \
  template double angle_condition<S>(const Problem<S>&, const Vector<S>&);
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm
