#pragma once

#include <vector>

#include "ball_problem.hpp"
#include "matrix_along.hpp"

namespace hbvm::core {

/// How errors of a motion change, to first order. The motion is q' = v, M v' = f(q, v) with f = grad U - grad g lambda
/// and lambda so that g'' = 0. Let K = grad^2 U - sum lambda_a grad^2 g_a, G = grad g, and
/// R = G^T M^-1 G the Gram matrix. Small changes of q and v change f by A and B times them,
///
///     A = K - G R^-1 (G^T M^-1 K + C),   C_a = v'^T grad^2 g_a + v^T (d/de) grad^2 g_a(q + e v),
///     B = -2 G R^-1 D,                   D_a = v^T grad^2 g_a.
///
/// Both are kept as L^-1 A L^-T, L^-1 B L^-T, where M = L L^T.
struct ErrorGrowth {
  BallMatrix A, B, gram_inverse;

  /// A bound of the logarithmic norm: (d/dt) |e| <= rate |e|. The length of an error e = (dq, dv) is given by
  /// |e|^2 = dv^T M dv + omega^2 dq^T M dq.
  double rate(double omega) const;
};

/// The motion near one time, or at the times of a ball: the values of positions, velocities and accelerations.
struct PathBox {
  std::vector<RealBall> q, v, acceleration;
};

/// What the growth of errors needs of a problem.
class ErrorGrowthIn {
 public:
  /// \throws IntegrationError if the mass matrix cannot be told from one that is not positive definite
  explicit ErrorGrowthIn(const BallProblem& problem);

  /// The growth anywhere on the path for times in `times`. By the mean value theorem it is what it is at the middle,
  /// and its derivative on the path times the distance from there. `middle` and `path` are the motion at the centre of
  /// the times, and at all of them. \throws IntegrationError if the Gram matrix may be singular somewhere, or the
  /// forces have no derivatives
  ErrorGrowth operator()(const PathBox& middle, const PathBox& path, const RealBall& times) const;
  /// The multipliers in a box.
  std::vector<RealBall> multipliers(const PathBox& box) const;

  /// How far an error of length 1 reaches: |dv_j| and omega |dq_j| are at most velocity_reach(j) |e|, and |dp_j| is at
  /// most momentum_reach(j) |e|.
  const RealBall& velocity_reach(Index j) const { return velocity_reach_[static_cast<std::size_t>(j)]; }
  const RealBall& momentum_reach(Index j) const { return momentum_reach_[static_cast<std::size_t>(j)]; }
  /// The length of an error.
  RealBall length(const std::vector<RealBall>& dq, const std::vector<RealBall>& dv, const RealBall& omega) const;

 private:
  struct Along {
    MatrixAlong A, B, gram_inverse;
  };
  /// What follows from positions and velocities, and is not yet A and B.
  struct Local {
    MatrixAlong G, gram_inverse, lambda, acceleration;
    std::vector<BallSeries> q;           ///< along the path
    std::vector<MatrixAlong> curvature;  ///< grad^2 g_a
    std::vector<MatrixAlong> bending;    ///< its derivative along v, where it is not constant
  };
  Local local(const PathBox& box, bool with_rate) const;
  Along growth(const PathBox& box, bool with_rate) const;
  /// The second derivatives of a force along a path, and in `rates` of these the derivatives in time.
  MatrixAlong hessian(const BallForce& force, const std::vector<BallSeries>& q, bool with_rate,
                      MatrixAlong* rates = nullptr) const;

  const BallProblem& problem_;
  BallMatrix L_inverse_;
  std::vector<RealBall> velocity_reach_, momentum_reach_;
};

}  // namespace hbvm::core
