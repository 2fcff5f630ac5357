#pragma once

#include "hbvm/linear/matrix.hpp"

namespace hbvm {

/// Where the gradient of one constraint goes, in all lanes: a column for each of its coordinates, ascending; and g, if
/// it is not null. x, y (lanes x dimension) and t are scratch.
template <Scalar S>
struct GradientTarget {
  Index lanes;
  S* columns;
  S* g;
  Matrix<S>&x, &y;
  S& t;

  S* column(Index k) const { return columns + k * lanes; }
};

}  // namespace hbvm
