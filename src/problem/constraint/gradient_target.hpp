#pragma once

#include "linear/matrix.hpp"

namespace hbvm::core {

/// Where the gradient of one constraint goes, in all lanes: a column for each of its coordinates, ascending; and g, if
/// it is not null. x, y (lanes x dimension) and t are scratch. Count is the type of the number of lanes, as of Lanes.
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
