#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "linear/index.hpp"

namespace hbvm::core {

/// The factors of the columns from `first` to `end` of an n x n matrix, from row `first` on. Of a whole matrix this is
/// P a = L U. Row k was exchanged with row pivots[k], in these columns alone. n and `end` may be constants of their
/// types.
/// \return false if a pivot is 0 or not finite
template <class Count>
[[nodiscard, gnu::always_inline]] inline bool factor_columns(double* a, Count n, Index first, Count end,
                                                             Index* pivots) {
  for (Index k = first; k < end; ++k) {
    double* const column = a + k * n;
    Index pivot = k;
    for (Index i = k + 1; i < n; ++i)
      if (std::abs(column[i]) > std::abs(column[pivot])) pivot = i;
    pivots[k] = pivot;
    if (column[pivot] == 0 || !std::isfinite(column[pivot])) return false;
    if (pivot != k)
      for (Index j = first; j < end; ++j) std::swap(a[k + j * n], a[pivot + j * n]);
    for (Index i = k + 1; i < n; ++i) column[i] /= column[k];
    for (Index j = k + 1; j < end; ++j) {
      double* const target = a + j * n;
      const double factor = target[k];
      for (Index i = k + 1; i < n; ++i) target[i] -= column[i] * factor;
    }
  }
  return true;
}

/// P a = L U in place, column after column of an n x n matrix, by blocks of columns. Every entry is the sum of the same
/// terms in the same order as without blocks, and as on any other processor.
/// \return false if a pivot is 0 or not finite
[[nodiscard]] bool factor_dense(double* a, Index n, std::vector<Index>& pivots);

}  // namespace hbvm::core
