#include "linear/dense_lu.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

namespace hbvm::core {
namespace {

/// Columns of a block: with all rows of some hundreds they fit the second cache.
constexpr Index block = 32;

/// As many numbers as the widest processors of today take at once without others being slowed down; those that take
/// fewer take them in parts.
constexpr Index lanes_in_register = 4;
using Register = double __attribute__((vector_size(lanes_in_register * sizeof(double))));

/// c -= l u, of rows x depth and depth x columns, all with columns `stride` apart.
[[gnu::always_inline]] inline void subtract_product_of_blocks(double* c, const double* l, const double* u, Index rows,
                                                              Index columns, Index depth, Index stride) {
  // Eight rows of four columns stay in registers.
  constexpr Index high = 2 * lanes_in_register, wide = 4;
  const Index whole_rows = rows - rows % high, whole_columns = columns - columns % wide;
  for (Index j = 0; j < whole_columns; j += wide) {
    const double* const factors = u + j * stride;
    for (Index i = 0; i < whole_rows; i += high) {
      double* const target = c + i + j * stride;
      Register upper[wide], lower[wide];
#pragma GCC unroll 4
      for (Index w = 0; w < wide; ++w) {
        std::memcpy(&upper[w], target + w * stride, sizeof(Register));
        std::memcpy(&lower[w], target + w * stride + lanes_in_register, sizeof(Register));
      }
      for (Index k = 0; k < depth; ++k) {
        const double* const column = l + i + k * stride;
        Register a, b;
        std::memcpy(&a, column, sizeof a);
        std::memcpy(&b, column + lanes_in_register, sizeof b);
#pragma GCC unroll 4
        for (Index w = 0; w < wide; ++w) {
          const double factor = factors[k + w * stride];
          upper[w] -= a * factor;
          lower[w] -= b * factor;
        }
      }
#pragma GCC unroll 4
      for (Index w = 0; w < wide; ++w) {
        std::memcpy(target + w * stride, &upper[w], sizeof(Register));
        std::memcpy(target + w * stride + lanes_in_register, &lower[w], sizeof(Register));
      }
    }
  }
  for (Index j = 0; j < columns; ++j)
    for (Index k = 0; k < depth; ++k) {
      const double factor = u[k + j * stride];
      for (Index i = j < whole_columns ? whole_rows : 0; i < rows; ++i) c[i + j * stride] -= l[i + k * stride] * factor;
    }
}

#ifdef __x86_64__
[[gnu::target("avx2")]] void subtract_by_four(double* c, const double* l, const double* u, Index rows, Index columns,
                                              Index depth, Index stride) {
  subtract_product_of_blocks(c, l, u, rows, columns, depth, stride);
}
bool takes_four() { return __builtin_cpu_supports("avx2") != 0; }
#else
constexpr auto subtract_by_four = subtract_product_of_blocks;
bool takes_four() { return false; }
#endif

void subtract_product(double* c, const double* l, const double* u, Index rows, Index columns, Index depth,
                      Index stride) {
  if (takes_four())
    subtract_by_four(c, l, u, rows, columns, depth, stride);
  else
    subtract_product_of_blocks(c, l, u, rows, columns, depth, stride);
}

}  // namespace

bool factor_dense(double* a, Index n, std::vector<Index>& pivots) {
  for (Index first = 0; first < n; first += block) {
    const Index end = std::min(first + block, n);
    if (!factor_columns(a, n, first, end, pivots.data())) return false;
    for (Index j = 0; j < n; ++j) {
      if (j == first) j = end;
      if (j >= n) break;
      double* const column = a + j * n;
      for (Index k = first; k < end; ++k) std::swap(column[k], column[pivots[static_cast<std::size_t>(k)]]);
      if (j < end) continue;
      // Rows of the block of U.
      for (Index k = first; k < end; ++k)
        for (Index i = k + 1; i < end; ++i) column[i] -= a[i + k * n] * column[k];
    }
    if (end < n)
      subtract_product(a + end + end * n, a + end + first * n, a + first + end * n, n - end, n - end, end - first, n);
  }
  return true;
}

}  // namespace hbvm::core
