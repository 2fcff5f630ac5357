#pragma once

#include <algorithm>
#include <set>
#include <vector>

#include "problem/constraint/gradient_target.hpp"
#include "problem/space/displacement.hpp"

namespace hbvm::core {

/// How derivatives by displacements spread over the coordinates that these are made of. Columns of a gradient are
/// weighted sums of the components of a vector x, and of another y.
template <Scalar S>
class GradientShares {
 public:
  enum class Of { x, y };

  /// \param coordinates of the gradient, ascending
  GradientShares(Index dimension, const std::vector<Index>& coordinates)
      : dimension_(dimension), coordinates_(coordinates) {}

  /// The columns of what `moving` is made of get its weights times the vector.
  void add(const Displacement<S>& moving, Of vector) {
    for (const auto& block : moving.blocks) {
      const Index column = first_column(block);
      shares_.push_back({column, vector, touched_.insert(column).second, block.weight});
    }
  }

  /// The columns of a block are next to each other, from this one on.
  Index first_column(const typename Displacement<S>::Block& block) const {
    const auto at = std::lower_bound(coordinates_.begin(), coordinates_.end(), block.offset);
    return static_cast<Index>(at - coordinates_.begin());
  }

  /// Computes the columns from x and y of the target.
  template <class Count>
  void spread(const GradientTarget<S, Count>& to) const {
    const Index size = dimension_ * to.lanes;
    for (const Share& share : shares_) {
      const S* const from = (share.vector == Of::x ? to.x : to.y).data();
      S* const columns = to.column(share.column);
      if (!share.first)
        add_weighted(columns, share.weight, from, size, to.t);
      else if (share.weight == 1)
        for (Index i = 0; i < size; ++i) set(columns[i], from[i]);
      else if (share.weight == -1)
        for (Index i = 0; i < size; ++i) set_negative(columns[i], from[i]);
      else
        for (Index i = 0; i < size; ++i) set_product(columns[i], share.weight, from[i]);
    }
  }

  /// The operations of spread() in one lane.
  OperationCounts operations() const {
    OperationCounts counts;
    for (const Share& share : shares_) {
      if (!share.first)
        counts += weighted_sum(share.weight, dimension_);
      else if (share.weight == -1)
        counts.add(Op::negate, dimension_);
      else if (share.weight != 1)
        counts.add(Op::multiply, dimension_);
    }
    return counts;
  }

 private:
  /// So many columns as there are components = weight vector, or += if it is not the first.
  struct Share {
    Index column;
    Of vector;
    bool first;
    S weight;
  };

  Index dimension_;
  std::vector<Index> coordinates_;
  std::vector<Share> shares_;
  std::set<Index> touched_;
};

}  // namespace hbvm::core
