#include "problem/regularity.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>
#include <set>

#include "linear/lu.hpp"
#include "problem/constraint_gradient.hpp"
#include "problem/gram_factor.hpp"
#include "problem/mass_block.hpp"

namespace hbvm::core {
namespace {

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

/// The largest eigenvalue of a symmetric operator on n numbers, to three digits and more, by Lanczos' iteration.
double largest_eigenvalue(Index n, const std::function<void(Vector<double>&)>& apply) {
  const Index most = std::min<Index>(n, 300);
  Vector<double> before = Vector<double>::Zero(n), v(n);
  // Any start will do that has a part of every eigenvector.
  for (Index i = 0; i < n; ++i) v[i] = static_cast<double>(1 + (i * i + 7 * i) % 31);
  v.normalize();
  std::vector<double> diagonal, beside;
  for (Index step = 0; step < most; ++step) {
    Vector<double> next = v;
    apply(next);
    diagonal.push_back(next.dot(v));
    next -= diagonal.back() * v;
    if (!beside.empty()) next -= beside.back() * before;
    const double size = next.norm();
    if (!(size > std::numeric_limits<double>::epsilon() * diagonal.front()) || step + 1 == most) break;
    beside.push_back(size);
    before = v;
    v = next / size;
  }
  const auto count = static_cast<Index>(diagonal.size());
  Eigen::SelfAdjointEigenSolver<Matrix<double>> eigen;
  eigen.computeFromTridiagonal(Eigen::Map<const Vector<double>>(diagonal.data(), count),
                               Eigen::Map<const Vector<double>>(beside.data(), count - 1), Eigen::EigenvaluesOnly);
  return eigen.eigenvalues().maxCoeff();
}

/// The condition of the Gram matrix of many constraints, D A D. \param scale the diagonal of D
template <Scalar S>
double condition_of_many(ConstraintGradient<S>& gradient, const Vector<S>& scale) {
  const Index nu = scale.size();
  struct Product {
    Index a, b;
    double value;
  };
  std::vector<Product> products;
  S product;
  gradient.for_each_own_coupling(Index{1}, &product, [&](Index a, Index b, const auto& at) {
    products.push_back({a, b, approximately(S(at(0, 0) * scale[a] * scale[b]))});
  });
  GramFactor<S> gram;
  if (!gram.factor(gradient, nu)) return std::numeric_limits<double>::infinity();
  const double largest = largest_eigenvalue(nu, [&](Vector<double>& x) {
    Vector<double> result = Vector<double>::Zero(nu);
    for (const Product& p : products) result[p.a] += p.value * x[p.b];
    x = result;
  });
  Vector<S> y(nu);
  return largest * largest_eigenvalue(nu, [&](Vector<double>& x) {
           for (Index a = 0; a < nu; ++a) y[a] = S(x[a]) / scale[a];
           gram.solve(y);
           for (Index a = 0; a < nu; ++a) x[a] = approximately(S(y[a] / scale[a]));
         });
}

template <Scalar S>
Mpfr exact(const S& x) {
  return rounded_to<Mpfr>(raw(exactly(x)));
}

/// What is not 0 of a row or column, by ascending places.
struct Entry {
  Index at;
  Mpfr value;
};
using Entries = std::vector<Entry>;

const Mpfr* find(const Entries& entries, Index at) {
  const auto place =
      std::lower_bound(entries.begin(), entries.end(), at, [](const Entry& entry, Index i) { return entry.at < i; });
  return place != entries.end() && place->at == at ? &place->value : nullptr;
}

/// Cholesky's factor of a Gram matrix whose rows and columns are taken in some order. But for what is left over, grad
/// g_a is a combination of the gradients of `pivots`. Row a of L has its scalar products with an orthonormal basis of
/// theirs. Constraints that share no body have no entry: what is not 0 is all that is stored and computed.
struct Cholesky {
  std::vector<Entries> gram, L;  ///< rows
  std::vector<Index> pivots;
  Mpfr least = 1;  ///< of the squared sines of the pivots' angles with those before

  explicit Cholesky(std::vector<Entries> rows) : gram(std::move(rows)), L(gram.size()), columns_(gram.size()) {
    for (std::size_t a = 0; a < gram.size(); ++a) {
      left_.push_back(length(static_cast<Index>(a)));
      order_.push_back(not_yet);
    }
  }

  Index size() const { return static_cast<Index>(gram.size()); }
  Index rank() const { return static_cast<Index>(pivots.size()); }
  Index pivot(Index k) const { return pivots[static_cast<std::size_t>(k)]; }

  /// The square of |grad g_a|.
  Mpfr length(Index a) const {
    const Mpfr* const found = find(row(gram, a), a);
    return found ? *found : Mpfr(0);
  }
  /// The squared sine of the angle of grad g_a with the pivots' gradients; 0 if it vanishes.
  Mpfr square_of_sine(Index a) const {
    const Mpfr whole = length(a);
    return whole == 0 ? Mpfr(0) : Mpfr(left_[static_cast<std::size_t>(a)] / whole);
  }

  /// Makes a constraint the next pivot, and takes its share from those that are left.
  void add(Index a, const Mpfr& sine) {
    const Index k = rank();
    const Mpfr of_a = sqrt(Mpfr(sine * length(a)));
    pivots.push_back(a);
    order_[static_cast<std::size_t>(a)] = k;
    if (sine < least) least = sine;
    for (const Index b : neighbours(a)) {
      const Mpfr share = left_over(b, a) / of_a;
      if (share == 0) continue;
      row(L, b).push_back({k, share});
      columns_[static_cast<std::size_t>(k)].push_back(b);
      left_[static_cast<std::size_t>(b)] -= share * share;
    }
    row(L, a).push_back({k, of_a});
  }

  /// x with grad g_a = sum_k x_k grad g_pivot(k), over the pivots before a if it is one.
  Vector<Mpfr> combination(Index a) const {
    const Index own = order_[static_cast<std::size_t>(a)], count = own == not_yet ? rank() : own;
    Vector<Mpfr> x = Vector<Mpfr>::Zero(count);
    for (Index k = count - 1; k >= 0; --k) {
      const Mpfr* const found = find(row(L, a), k);
      Mpfr sum = found ? *found : Mpfr(0);
      std::vector<Index> later;
      for (const Index b : columns_[static_cast<std::size_t>(k)])
        if (const Index c = order_[static_cast<std::size_t>(b)]; c != not_yet && c < count) later.push_back(c);
      std::sort(later.begin(), later.end());
      for (const Index c : later) sum -= *find(row(L, pivot(c)), k) * x[c];
      if (sum != 0) x[k] = sum / *find(row(L, pivot(k)), k);
    }
    return x;
  }
  /// The constraints that contribute more than round-off to it, ascending.
  std::vector<Index> contributors(Index a, const Vector<Mpfr>& x, const Mpfr& tolerance) const {
    std::vector<Index> result;
    const Mpfr negligible = tolerance * length(a);
    for (Index k = 0; k < x.size(); ++k)
      if (x[k] != 0 && x[k] * x[k] * length(pivot(k)) > negligible) result.push_back(pivot(k));
    std::sort(result.begin(), result.end());
    return result;
  }

 private:
  static constexpr Index not_yet = -1;

  static Entries& row(std::vector<Entries>& rows, Index a) { return rows[static_cast<std::size_t>(a)]; }
  static const Entries& row(const std::vector<Entries>& rows, Index a) { return rows[static_cast<std::size_t>(a)]; }

  /// Those that are left and have a scalar product with what is left of grad g_a.
  std::set<Index> neighbours(Index a) const {
    std::set<Index> found;
    const auto take = [&](Index b) {
      if (order_[static_cast<std::size_t>(b)] == not_yet) found.insert(b);
    };
    for (const Entry& entry : row(gram, a)) take(entry.at);
    for (const Entry& entry : row(L, a))
      for (const Index b : columns_[static_cast<std::size_t>(entry.at)]) take(b);
    return found;
  }

  /// The scalar product of grad g_a with the next vector of the basis, which grad g_b is to give. It is times the
  /// length of what is left of grad g_b.
  Mpfr left_over(Index a, Index b) const {
    const Mpfr* const product = find(row(gram, a), b);
    Mpfr sum = product ? *product : Mpfr(0);
    const Entries &x = row(L, a), &y = row(L, b);
    for (auto i = x.begin(), j = y.begin(); i != x.end() && j != y.end();) {
      if (i->at == j->at) sum -= i->value * j->value;
      const bool behind = i->at <= j->at, ahead = j->at <= i->at;
      i += behind;
      j += ahead;
    }
    return sum;
  }

  std::vector<std::vector<Index>> columns_;  ///< of L below the pivots: whose they are
  std::vector<Mpfr> left_;                   ///< the square of what is left of each gradient
  std::vector<Index> order_;                 ///< the place of each among the pivots
};

/// In the order of the constraints, which leaves most zeros; stops at the first that is dependent.
/// \return the one nearest to those before, or none if it stopped
std::optional<Index> factor_in_order(Cholesky& cholesky, const Mpfr& tolerance) {
  Index nearest = 0;
  for (Index a = 0; a < cholesky.size(); ++a) {
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
  std::vector<Index> rest(static_cast<std::size_t>(cholesky.size()));
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
    const Index a = *next;
    rest.erase(next);
    cholesky.add(a, farthest);
  }
  return cholesky.pivots.empty() ? 0 : cholesky.pivots.back();
}

/// Column a of grad g, rounded, and of M^-1 times it.
template <Scalar S>
Entries exact_column(const ConstraintGradient<S>& gradient, Index a) {
  const auto& pattern = gradient.pattern(a);
  Entries column;
  for (std::size_t k = 0; k < pattern.coordinates.size(); ++k)
    if (const S& value = gradient.values()(0, pattern.first + static_cast<Index>(k)); value != 0)
      column.push_back({pattern.coordinates[k], exact(value)});
  return column;
}
template <Scalar S>
Entries weighted(const Problem<S>& problem, const Entries& column) {
  Entries result;
  const auto end = std::find_if(column.begin(), column.end(),
                                [&](const Entry& entry) { return entry.at >= problem.mass.of_bodies(); });
  for (auto first = column.begin(); first != end;) {
    const auto& block = block_of(problem.mass, first->at);
    auto last = first;
    while (last != end && last->at < block.offset + block.size) ++last;
    if (!block.full) {
      for (; first != last; ++first) result.push_back({first->at, Mpfr(exact(block.inverse_mass) * first->value)});
      continue;
    }
    for (Index j = 0; j < block.size; ++j) {
      Mpfr sum = 0;
      for (auto entry = first; entry != last; ++entry)
        sum += exact(block.W(j, entry->at - block.offset)) * entry->value;
      if (sum != 0) result.push_back({block.offset + j, sum});
    }
    first = last;
  }
  return result;
}

/// The exact Gram matrix of the rounded gradients and inverse masses, row by row.
template <Scalar S>
std::vector<Entries> exact_gram(const Problem<S>& problem, const ConstraintGradient<S>& gradient) {
  std::vector<Entries> columns, rows(static_cast<std::size_t>(problem.nu()));
  for (Index a = 0; a < problem.nu(); ++a) columns.push_back(exact_column(gradient, a));
  Index last = -1;
  Entries of_last;
  for (const auto& pair : gradient.couplings()) {
    if (pair.b > pair.a) continue;
    if (pair.a != last) of_last = weighted(problem, columns[static_cast<std::size_t>(pair.a)]);
    last = pair.a;
    Mpfr sum = 0;
    for (const Entry& entry : columns[static_cast<std::size_t>(pair.b)])
      if (const Mpfr* const other = find(of_last, entry.at)) sum += entry.value * *other;
    if (sum == 0) continue;
    rows[static_cast<std::size_t>(pair.a)].push_back({pair.b, sum});
    if (pair.a != pair.b) rows[static_cast<std::size_t>(pair.b)].push_back({pair.a, sum});
  }
  return rows;
}

/// What the round-off of velocities is proportional to. In a block of M they are sums M^-1 p of terms M v, which may
/// cancel.
template <Scalar S>
Vector<S> sizes_of_velocities(const MassMatrix<S>& mass, const Vector<S>& v) {
  Vector<S> sizes(v.size());
  for (Index i = 0; i < v.size(); ++i) sizes[i] = magnitude(v[i]);
  for (const auto& block : mass.blocks()) {
    if (!block.full) continue;
    Vector<S> p = Vector<S>::Zero(block.size);
    for (Index j = 0; j < block.size; ++j)
      for (Index l = 0; l < block.size; ++l) p[j] += magnitude(S(block.M(j, l) * v[block.offset + l]));
    for (Index j = 0; j < block.size; ++j) {
      S sum = 0;
      for (Index l = 0; l < block.size; ++l) sum += magnitude(block.W(j, l)) * p[l];
      raise_to(sizes[block.offset + j], sum);
    }
  }
  return sizes;
}

}  // namespace

template <Scalar S>
Independence<S> find_independent(const Problem<S>& problem, const Vector<S>& q, const Vector<S>& v, const S& rounding) {
  const Index m = problem.m(), nu = problem.nu();
  Independence<S> result;
  if (nu == 0) return result;
  ConstraintGradient<S> gradient(problem, 1);
  gradient.update(lanes(q));
  // A gradient's direction is known to a few roundings of its entries.
  const S resolution = S(static_cast<long>(64 * m)) * rounding;
  Matrix<S> bending(nu, 2);  // with the sizes of its terms
  const Vector<S> sizes = sizes_of_velocities(problem.mass, v);
  for (Index a = 0; a < nu; ++a) {
    const auto& constraint = problem.constraints[static_cast<std::size_t>(a)];
    bending(a, 0) = curvature(constraint, problem.dimension, q, v);
    bending(a, 1) = curvature_size(constraint, problem.dimension, q, sizes);
  }

  std::vector<std::array<BigFloat, 2>> bendings;  // of the redundant ones, with bounds of their round-off
  BigFloat square_of_sine(1);
  const int digits = digits10<S>();
  {
    const PrecisionScope guarded(static_cast<unsigned>(2 * digits + 20));
    const Mpfr bound = exact(resolution), tolerance = bound * bound;
    Cholesky cholesky(exact_gram(problem, gradient));
    auto nearest = factor_in_order(cholesky, tolerance);
    if (!nearest) {
      cholesky = Cholesky(std::move(cholesky.gram));
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
      const Mpfr own = cholesky.length(a);
      for (Index k = 0; k < x.size(); ++k) {
        if (x[k] == 0) continue;
        const Index b = cholesky.pivot(k);
        sum -= x[k] * exact(bending(b, 0));
        // How much of grad g_b there is in it is known to the rounding of both.
        size += (magnitude(x[k]) + sqrt(Mpfr(own / cholesky.length(b)))) * exact(bending(b, 1));
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
  const Index nu = problem.nu();
  if (nu < many_constraints) return nu == 0 ? 1 : condition(gram_matrix(problem, q));
  ConstraintGradient<S> gradient(problem, 1);
  gradient.update(lanes(q));
  return condition_of_many(gradient, Vector<S>(Vector<S>::Constant(nu, S(1))));
}

template <Scalar S>
double angle_condition(const Problem<S>& problem, const Vector<S>& q) {
  using std::sqrt;
  const Index nu = problem.nu();
  if (nu == 0) return 1;
  Vector<S> length(nu);
  if (nu >= many_constraints) {
    ConstraintGradient<S> gradient(problem, 1);
    gradient.update(lanes(q));
    S product;
    gradient.for_each_own_coupling(Index{1}, &product, [&](Index a, Index b, const auto& at) {
      if (a == b) length[a] = 1 / S(sqrt(at(0, 0)));
    });
    return condition_of_many(gradient, length);
  }
  Matrix<S> gram = gram_matrix(problem, q);
  for (Index a = 0; a < nu; ++a) length[a] = sqrt(gram(a, a));
  for (Index b = 0; b < nu; ++b)
    for (Index a = 0; a < nu; ++a) gram(a, b) = a == b ? S(1) : S(gram(a, b) / (length[a] * length[b]));
  return condition(gram);
}

#define HBVM_DEFINE(S)                                                                                           \
  template Independence<S> find_independent<S>(const Problem<S>&, const Vector<S>&, const Vector<S>&, const S&); \
  template void set_aside<S>(Problem<S>&, const Independence<S>&);                                               \
  template double gram_condition<S>(const Problem<S>&, const Vector<S>&);                                        \
  template double angle_condition<S>(const Problem<S>&, const Vector<S>&);
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
