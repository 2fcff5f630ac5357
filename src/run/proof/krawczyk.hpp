#pragma once

#include <vector>

#include "reference/proof/ball_matrix.hpp"

namespace hbvm::core {

/// The greatest entry of a column, each in a unit of its own. Of one that is not finite it is not finite either.
RealBall size_of(const BallMatrix& column, const std::vector<RealBall>& units);

/// Krawczyk's test of equations F(x) = 0 in a box about an approximate root. An entry of x is at most `radius` times
/// its unit from the centre. With any matrix Y, the map x -> x - Y F(x) takes the box into itself if
///
///     |Y F(centre)| + |1 - Y J| radius < radius,
///
/// J being all derivatives in the box. So there is a root. There is one only, since J is regular then. (R. Krawczyk,
/// Computing 4, 1969; S. M. Rump, Verification methods, Acta Numerica 19, 2010, section 13.)
class Krawczyk {
 public:
  /// \param J  holds the derivatives in the box \param residual  holds F(centre), for each F of a set of equations
  Krawczyk(const BallMatrix& J, const BallMatrix& residual, const std::vector<RealBall>& units, const RealBall& radius);

  /// Whether there is one root in the box and no other, for each F.
  bool proves() const { return proves_; }
  /// If so, the root is no farther from the centre.
  const RealBall& distance() const { return distance_; }

 private:
  bool proves_ = false;
  RealBall distance_;
};

}  // namespace hbvm::core
