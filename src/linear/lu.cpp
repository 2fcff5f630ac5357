#include "linear/lu.hpp"

#include <algorithm>
#include <utility>

#include "linear/constant_count.hpp"
#include "linear/dense_lu.hpp"
#include "scalar/in_place.hpp"

namespace hbvm::core {

template <Scalar S>
void Lu<S>::resize(Index n, Index half_bandwidth) {
  n_ = n;
  b_ = std::max<Index>(std::min(half_bandwidth, n - 1), 0);
  const bool dense = 3 * b_ + 1 >= n;
  upper_ = dense ? std::max<Index>(n - 1, 0) : 2 * b_;
  stride_ = dense ? n : 3 * b_;
  offset_ = dense ? 0 : 2 * b_;
  data_.resize(static_cast<std::size_t>(dense ? n * n : (3 * b_ + 1) * n));
  pivots_.resize(static_cast<std::size_t>(n));
  // Smaller ones stay in the first cache, where blocks save nothing.
  constexpr Index large = 64;
  blocked_ = std::same_as<S, double> && dense && n >= large;
}

template <Scalar S>
void Lu<S>::set_zero() {
  for (S& x : data_) hbvm::core::set_zero(x);
}

template <Scalar S>
void Lu<S>::set(const Matrix<S>& a) {
  resize(a.rows(), a.rows());
  for (Index i = 0; i < a.size(); ++i) hbvm::core::set(data_[static_cast<std::size_t>(i)], a.data()[i]);
}

namespace {

/// Lu::factor() of a full matrix: rows[i] is the one that came to be the i-th.
template <class Count>
bool factor_few(double* a, Count n, Index* rows) {
  Index pivots[Count::value];
  if (!factor_columns(a, n, 0, n, pivots)) return false;
  for (Index k = 0; k < n; ++k) rows[k] = k;
  for (Index k = 0; k < n; ++k) std::swap(rows[k], rows[pivots[k]]);
  return true;
}

/// Lu::solve() of what factor_few() left.
template <class Count>
void solve_few(const double* a, Count n, const Index* rows, double* x) {
  double y[Count::value];
  for (Index k = 0; k < n; ++k) y[k] = x[rows[k]];
  for (Index k = 0; k < n; ++k)
    for (Index i = k + 1; i < n; ++i) y[i] -= a[i + k * n] * y[k];
  for (Index k = n - 1; k >= 0; --k) {
    y[k] *= a[k + k * n];
    for (Index i = 0; i < k; ++i) y[i] -= a[i + k * n] * y[k];
  }
  for (Index k = 0; k < n; ++k) x[k] = y[k];
}

/// f(n) with n as a constant of its type, for a full matrix of few unknowns in double. \return false for others
template <Scalar S, class F>
bool with_few(Index n, Index stride, F f) {
  if constexpr (std::same_as<S, double>)
    if (stride == n)
      return with_constant_count<S>(n, [&]<class Count>(Count) {
        if constexpr (is_constant_count<Count>) f(Count());
        return is_constant_count<Count>;
      });
  return false;
}

}  // namespace

template <Scalar S>
bool Lu<S>::factor() {
  if constexpr (std::same_as<S, double>) {
    if (blocked_) return factor_dense(data_.data(), n_, pivots_) && invert_pivots();
    bool regular = false;
    const auto factor_in_place = [&](auto n) { regular = factor_few(data_.data(), n, pivots_.data()); };
    if (with_few<S>(n_, stride_, factor_in_place)) return regular && invert_pivots();
  }
  S& t = scratch<S>();
  for (Index k = 0; k < n_; ++k) {
    const Index last_row = std::min(n_ - 1, k + b_), last_column = std::min(n_ - 1, k + upper_);
    S* const column = &entry(0, k);
    Index pivot = k;
    for (Index i = k + 1; i <= last_row; ++i)
      if (exceeds(column[i], column[pivot])) pivot = i;
    pivots_[static_cast<std::size_t>(k)] = pivot;
    if (column[pivot] == 0 || !is_finite(column[pivot])) return false;
    if (pivot != k) {
      using std::swap;
      for (Index j = k; j <= last_column; ++j) swap(entry(k, j), entry(pivot, j));
    }
    for (Index i = k + 1; i <= last_row; ++i) set_quotient(column[i], column[i], column[k]);
    for (Index j = k + 1; j <= last_column; ++j) {
      S* const target = &entry(0, j);
      const S& factor = target[k];
      if (factor == 0) continue;
      for (Index i = k + 1; i <= last_row; ++i) subtract_product(target[i], column[i], factor, t);
    }
  }
  return invert_pivots();
}

template <Scalar S>
bool Lu<S>::invert_pivots() {
  bool finite = true;
  for (Index k = 0; k < n_; ++k) {
    S& pivot = entry(k, k);
    set_quotient(pivot, one_, pivot);
    finite = finite && is_finite(pivot);
  }
  return finite;
}

template <Scalar S>
void Lu<S>::solve(S* x) {
  if constexpr (std::same_as<S, double>) {
    const auto solve_in_place = [&](auto n) { solve_few(data_.data(), n, pivots_.data(), x); };
    if (with_few<S>(n_, stride_, solve_in_place)) return;
  }
  S& t = scratch<S>();
  const auto exchange = [&](Index k) {
    using std::swap;
    if (const Index pivot = pivots_[static_cast<std::size_t>(k)]; pivot != k) swap(x[k], x[pivot]);
  };
  // Blocks exchange whole rows, those of L, too.
  if (blocked_)
    for (Index k = 0; k < n_; ++k) exchange(k);
  for (Index k = 0; k < n_; ++k) {
    if (!blocked_) exchange(k);
    const S* const column = &entry(0, k);
    const Index last_row = blocked_ ? n_ - 1 : std::min(n_ - 1, k + b_);
    for (Index i = k + 1; i <= last_row; ++i) subtract_product(x[i], column[i], x[k], t);
  }
  for (Index k = n_ - 1; k >= 0; --k) {
    const S* const column = &entry(0, k);
    set_product(x[k], x[k], column[k]);
    for (Index i = std::max<Index>(0, k - upper_); i < k; ++i) subtract_product(x[i], column[i], x[k], t);
  }
}

template <Scalar S>
void Lu<S>::remember(Archive& archive) {
  archive(data_, pivots_);
}

template <Scalar S>
OperationCounts Lu<S>::factor_operations() const {
  OperationCounts counts;
  for (Index k = 0; k < n_; ++k) {
    const Index rows = std::min(n_ - 1 - k, b_), columns = std::min(n_ - 1 - k, upper_);
    counts.add(Op::reciprocal, rows + 1);
    counts.add(Op::multiply, rows * columns);
    counts.add(Op::subtract, rows * columns);
  }
  return counts;
}

template <Scalar S>
OperationCounts Lu<S>::solve_operations() const {
  OperationCounts counts;
  for (Index k = 0; k < n_; ++k) {
    const Index products = std::min(n_ - 1 - k, b_) + std::min(k, upper_);
    counts.add(Op::multiply, products + 1);
    counts.add(Op::subtract, products);
  }
  return counts;
}

#define HBVM_DEFINE(S) template class Lu<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
