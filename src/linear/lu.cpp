#include "hbvm/linear/lu.hpp"

#include <utility>

#include "hbvm/scalar/in_place.hpp"

namespace hbvm {

template <Scalar S>
bool Lu<S>::factor() {
  const Index n = lu_.rows();
  pivots_.resize(static_cast<std::size_t>(n));
  S t;
  for (Index k = 0; k < n; ++k) {
    Index pivot = k;
    S largest = magnitude(lu_(k, k));
    for (Index i = k + 1; i < n; ++i) {
      const S candidate = magnitude(lu_(i, k));
      if (candidate > largest) {
        largest = candidate;
        pivot = i;
      }
    }
    pivots_[static_cast<std::size_t>(k)] = pivot;
    if (!(largest > 0) || !is_finite(largest)) return false;
    if (pivot != k) {
      using std::swap;
      for (Index j = 0; j < n; ++j) swap(lu_(k, j), lu_(pivot, j));
    }
    for (Index i = k + 1; i < n; ++i) set_quotient(lu_(i, k), lu_(i, k), lu_(k, k));
    for (Index j = k + 1; j < n; ++j)
      for (Index i = k + 1; i < n; ++i) subtract_product(lu_(i, j), lu_(i, k), lu_(k, j), t);
  }
  return true;
}

template <Scalar S>
void Lu<S>::solve(Vector<S>& x) {
  const Index n = lu_.rows();
  S t;
  // factor() swapped whole rows, the part of L already there included: permute first, then substitute.
  for (Index k = 0; k < n; ++k) {
    using std::swap;
    swap(x[k], x[pivots_[static_cast<std::size_t>(k)]]);
  }
  for (Index k = 0; k < n; ++k)
    for (Index i = k + 1; i < n; ++i) subtract_product(x[i], lu_(i, k), x[k], t);
  for (Index k = n - 1; k >= 0; --k) {
    set_quotient(x[k], x[k], lu_(k, k));
    for (Index i = 0; i < k; ++i) subtract_product(x[i], lu_(i, k), x[k], t);
  }
}

#define HBVM_DEFINE(S) template class Lu<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm
