#pragma once

#include <vector>

#include "hbvm/linear/index.hpp"

namespace hbvm {

/// P a = L U in place, column after column of an n x n matrix, by blocks of columns. Every entry is the sum of the same
/// terms in the same order as without blocks, and as on any other processor.
/// \return false if a pivot is 0 or not finite
[[nodiscard]] bool factor_dense(double* a, Index n, std::vector<Index>& pivots);

}  // namespace hbvm
