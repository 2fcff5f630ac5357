#pragma once

#include <vector>

#include "reference/proof/ball_matrix.hpp"

namespace hbvm::core {

/// The coefficients of HBVM(k, s) as balls that hold them, with the names of Hbvm.
struct BallMethod {
  int k = 0, s = 0, r = 0;
  std::vector<RealBall> b, b_hat;
  BallMatrix P, I;                    ///< r x s
  BallMatrix P_hat, I_hat;            ///< k x s
  BallMatrix X;                       ///< s x s
  std::vector<RealBall> lambda_at_1;  ///< s

  bool has_coefficients_of_lambda() const { return r > s; }
};

/// In the bits of the BallScope. Nodes and weights are Arb's, which are proved; the rest follows from them.
BallMethod make_ball_method(int k, int s, int r);

}  // namespace hbvm::core
