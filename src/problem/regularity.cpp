#include "hbvm/problem/regularity.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <optional>

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

template <Scalar S>
Mpfr exact(const S& x) {
  return rounded_to<Mpfr>(raw(exactly(x)));
}

/// Cholesky's factor of a Gram matrix whose rows and columns are taken in some order: grad g_a is, but for what is left
/// over, a combination of the gradients of `pivots`, with the scalar products L_a. in an orthonormal basis of theirs.
struct Cholesky {
  Matrix<Mpfr> gram, L;
  std::vector<Index> pivots;
  Mpfr least = 1;  ///< of the squared sines of the pivots' angles with those before

  explicit Cholesky(Matrix<Mpfr> matrix) : gram(std::move(matrix)), L(Matrix<Mpfr>::Zero(gram.rows(), gram.rows())) {}

  Index rank() const { return static_cast<Index>(pivots.size()); }
  Index pivot(Index k) const { return pivots[static_cast<std::size_t>(k)]; }

  /// The scalar product of grad g_a with the next vector of the basis, which grad g_b is to give, times the length of
  /// what is left of grad g_b; for b = a that length squared.
  Mpfr left_over(Index a, Index b) const {
    Mpfr sum = gram(a, b);
    for (Index c = 0; c < rank(); ++c)
      if (L(a, c) != 0 && L(b, c) != 0) sum -= L(a, c) * L(b, c);
    return sum;
  }
  /// The squared sine of the angle of grad g_a with the pivots' gradients; 0 if it vanishes.
  Mpfr square_of_sine(Index a) const { return gram(a, a) == 0 ? Mpfr(0) : Mpfr(left_over(a, a) / gram(a, a)); }

  void add(Index a, const Mpfr& sine) {
    const Index k = rank();
    L(a, k) = sqrt(Mpfr(sine * gram(a, a)));
    pivots.push_back(a);
    if (sine < least) least = sine;
  }

  /// x with grad g_a = sum_k x_k grad g_pivot(k), over the pivots before a if it is one.
  Vector<Mpfr> combination(Index a) const {
    const Index count = std::find(pivots.begin(), pivots.end(), a) - pivots.begin();
    Vector<Mpfr> x(count);
    for (Index k = count - 1; k >= 0; --k) {
      Mpfr sum = L(a, k);
      for (Index c = k + 1; c < count; ++c) sum -= L(pivot(c), k) * x[c];
      x[k] = sum / L(pivot(k), k);
    }
    return x;
  }
  /// The constraints that contribute more than round-off to it, ascending.
  std::vector<Index> contributors(Index a, const Vector<Mpfr>& x, const Mpfr& tolerance) const {
    std::vector<Index> result;
    for (Index k = 0; k < x.size(); ++k)
      if (x[k] * x[k] * gram(pivot(k), pivot(k)) > tolerance * gram(a, a)) result.push_back(pivot(k));
    std::sort(result.begin(), result.end());
    return result;
  }
};

/// In the order of the constraints, so that zeros stay; stops at the first that is dependent.
/// \return the one nearest to those before, or none if it stopped
std::optional<Index> factor_in_order(Cholesky& cholesky, const Mpfr& tolerance) {
  Index nearest = 0;
  for (Index a = 0; a < cholesky.gram.rows(); ++a) {
    for (Index k = 0; k < a; ++k) {
      Mpfr sum = cholesky.gram(k, a);
      for (Index c = 0; c < k; ++c)
        if (cholesky.L(a, c) != 0 && cholesky.L(k, c) != 0) sum -= cholesky.L(a, c) * cholesky.L(k, c);
      cholesky.L(a, k) = sum / cholesky.L(k, k);
    }
    const Mpfr sine = cholesky.square_of_sine(a);
    if (!(sine > tolerance)) return std::nullopt;
    if (sine < cholesky.least) nearest = a;
    cholesky.add(a, sine);
  }
  return nearest;
}

/// The one that stands farthest apart from those before comes next; an earlier one if it is about as far. Stops when
/// all that are left are dependent.
/// \return the last one
std::optional<Index> factor_with_pivots(Cholesky& cholesky, const Mpfr& tolerance) {
  std::vector<Index> rest(static_cast<std::size_t>(cholesky.gram.rows()));
  std::iota(rest.begin(), rest.end(), Index{0});
  while (!rest.empty()) {
    auto next = rest.begin();
    Mpfr farthest = 0;
    for (auto a = rest.begin(); a != rest.end(); ++a) {
      const Mpfr sine = cholesky.square_of_sine(*a);
      if (16 * sine <= 17 * farthest) continue;
      farthest = sine;
      next = a;
    }
    if (!(farthest > tolerance)) break;
    const Index a = *next, k = cholesky.rank();
    rest.erase(next);
    const Mpfr length = sqrt(Mpfr(farthest * cholesky.gram(a, a)));
    for (const Index b : rest) cholesky.L(b, k) = cholesky.left_over(b, a) / length;
    cholesky.add(a, farthest);
  }
  return cholesky.pivots.empty() ? 0 : cholesky.pivots.back();
}

/// The exact Gram matrix of the rounded gradients and inverse masses.
template <Scalar S>
Matrix<Mpfr> exact_gram(const Problem<S>& problem, const Matrix<S>& G) {
  const Index m = problem.m(), nu = problem.nu();
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
  Matrix<Mpfr> gram(nu, nu);
  for (Index a = 0; a < nu; ++a)
    for (Index b = 0; b <= a; ++b) {
      Mpfr sum = 0;
      for (Index i = 0; i < m; ++i)
        if (exact_G(i, b) != 0) sum += exact_G(i, b) * weighted(i, a);
      gram(a, b) = gram(b, a) = sum;
    }
  return gram;
}

}  // namespace

template <Scalar S>
Independence<S> find_independent(const Problem<S>& problem, const Vector<S>& q, const Vector<S>& v) {
  const Index m = problem.m(), nu = problem.nu();
  Independence<S> result;
  if (nu == 0) return result;
  ConstraintGradient<S> gradient(problem, 1);
  gradient.update(lanes(q));
  const Matrix<S> G = dense_gradient(gradient, problem);
  // A gradient's direction is known to a few roundings of its entries.
  const S resolution = S(static_cast<long>(64 * m)) * epsilon<S>();
  Matrix<S> bending(nu, 2);  // with the sizes of its terms
  for (Index a = 0; a < nu; ++a) {
    const auto& constraint = problem.constraints[static_cast<std::size_t>(a)];
    bending(a, 0) = curvature(constraint, problem.dimension, q, v);
    bending(a, 1) = curvature_size(constraint, problem.dimension, q, v);
  }

  std::vector<std::array<BigFloat, 2>> bendings;  // of the redundant ones, with bounds of their round-off
  BigFloat square_of_sine(1);
  const int digits = digits10<S>();
  {
    const PrecisionScope guarded(static_cast<unsigned>(2 * digits + 20));
    const Mpfr bound = exact(resolution), tolerance = bound * bound;
    Cholesky cholesky(exact_gram(problem, G));
    auto nearest = factor_in_order(cholesky, tolerance);
    if (!nearest) {
      cholesky = Cholesky(Matrix<Mpfr>(cholesky.gram));
      nearest = factor_with_pivots(cholesky, tolerance);
    }
    result.kept = cholesky.pivots;
    std::sort(result.kept.begin(), result.kept.end());
    result.nearest = *nearest;
    result.near = cholesky.contributors(*nearest, cholesky.combination(*nearest), tolerance);
    square_of_sine = exactly(cholesky.least);
    for (Index a = 0; a < nu; ++a) {
      if (std::binary_search(result.kept.begin(), result.kept.end(), a)) continue;
      const Vector<Mpfr> x = cholesky.combination(a);
      Mpfr sum = exact(bending(a, 0)), size = exact(bending(a, 1));
      for (Index k = 0; k < x.size(); ++k) {
        sum -= x[k] * exact(bending(cholesky.pivot(k), 0));
        size += magnitude(x[k]) * exact(bending(cholesky.pivot(k), 1));
      }
      result.redundant.push_back({a, cholesky.contributors(a, x, tolerance), S(0), S(0)});
      // The combination is known the less the nearer the kept ones are to one another.
      bendings.push_back({exactly(sum), exactly(Mpfr(bound * size / sqrt(cholesky.least)))});
    }
  }
  result.square_of_sine = rounded_to<S>(raw(square_of_sine));
  for (std::size_t r = 0; r < bendings.size(); ++r) {
    result.redundant[r].bending = rounded_to<S>(raw(bendings[r][0]));
    result.redundant[r].round_off = rounded_to<S>(raw(bendings[r][1]));
  }
  return result;
}

template <Scalar S>
void set_aside(Problem<S>& problem, const Independence<S>& independence) {
  const auto constraint = [&](Index a) { return problem.constraints[static_cast<std::size_t>(a)]; };
  for (const Dependence<S>& dependence : independence.redundant)
    problem.redundant.push_back({dependence.constraint, constraint(dependence.constraint)});
  std::vector<Constraint<S>> kept;
  for (const Index a : independence.kept) kept.push_back(constraint(a));
  problem.constraints = std::move(kept);
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

#define HBVM_DEFINE(S)                                                                                 \
  template Independence<S> find_independent<S>(const Problem<S>&, const Vector<S>&, const Vector<S>&); \
  template void set_aside<S>(Problem<S>&, const Independence<S>&);                                     \
  template double gram_condition<S>(const Problem<S>&, const Vector<S>&);                              \
  template double angle_condition<S>(const Problem<S>&, const Vector<S>&);
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm
