#pragma once

#include <algorithm>

#include "problem/mass_matrix.hpp"

namespace hbvm::core {

/// The block of M that a coordinate of a body is in.
template <Scalar S>
const typename MassMatrix<S>::Block& block_of(const MassMatrix<S>& mass, Index coordinate) {
  const auto& blocks = mass.blocks();
  return *(std::upper_bound(blocks.begin(), blocks.end(), coordinate,
                            [](Index at, const auto& block) { return at < block.offset; }) -
           1);
}

}  // namespace hbvm::core
