#include "linear/inverse_diagonal.hpp"

#include <algorithm>

namespace hbvm::core {

template <Scalar S>
void InverseDiagonal<S>::resize(Index n, Index half_bandwidth) {
  n_ = n;
  b_ = std::max<Index>(std::min(half_bandwidth, n - 1), 0);
  a_.assign(static_cast<std::size_t>(n * (b_ + 1)), S(0));
  inverse_ = a_;
}

template <Scalar S>
void InverseDiagonal<S>::set_zero() {
  std::fill(a_.begin(), a_.end(), S(0));
}

template <Scalar S>
bool InverseDiagonal<S>::compute() {
  const auto last = [&](Index j) { return std::min(n_ - 1, j + b_); };
  // L below the diagonal, D on it.
  for (Index j = 0; j < n_; ++j) {
    if (!(entry(j, j) > 0) || !is_finite(entry(j, j))) return false;
    for (Index k = j + 1; k <= last(j); ++k) {
      const S l = entry(k, j) / entry(j, j);
      for (Index i = k; i <= last(j); ++i) entry(i, k) -= entry(i, j) * l;
    }
    for (Index i = j + 1; i <= last(j); ++i) entry(i, j) /= entry(j, j);
  }
  const auto product = [&](Index i, Index j) {  // (L^T - I) A^-1, row i and column j >= i
    S sum = 0;
    for (Index k = i + 1; k <= last(i); ++k) sum += entry(k, i) * inverse(std::max(k, j), std::min(k, j));
    return sum;
  };
  for (Index i = n_ - 1; i >= 0; --i) {
    for (Index j = last(i); j > i; --j) inverse(j, i) = -product(i, j);
    inverse(i, i) = 1 / entry(i, i) - product(i, i);
  }
  return true;
}

#define HBVM_DEFINE(S) template class InverseDiagonal<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
