#pragma once

#include "linear/matrix.hpp"

namespace hbvm::core {

/// The place for the gradient of one constraint, in all lanes: a column for each of its coordinates, ascending. g has a
/// place, too, if it is not null. x, y (lanes x dimension) and t are scratch. Count is the type of the number of lanes,
/// as of Lanes.
template <Scalar S, class Count = Index>
struct GradientTarget {
  Count lanes;
  S* columns;
  S* g;
  Matrix<S>&x, &y;
  S& t;

  S* column(Index k) const { return columns + k * lanes; }
};

}  // namespace hbvm::core
