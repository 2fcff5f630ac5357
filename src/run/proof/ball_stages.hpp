#pragma once

#include "ball_method.hpp"
#include "reference/proof/ball_problem.hpp"

namespace hbvm::core {

/// Where a step starts, and unknowns of its stage equations, as columns of balls.
struct StageBox {
  BallMatrix start;     ///< 2m: q0, and p0 below it
  BallMatrix unknowns;  ///< s (m + nu): gamma, a coefficient after the other, and lambda below them likewise
};

/// What the stage equations make of it.
struct StageImage {
  BallMatrix residual;  ///< that of StageResidual, momentum above constraint; 0 at a solution
  BallMatrix end;       ///< 2m: q1, and p1 below it, by (56)
};

/// Their derivatives, for all that is in a box.
struct StageDerivative {
  BallMatrix by_unknowns, by_start;          ///< of the residual
  BallMatrix end_by_unknowns, end_by_start;  ///< of the end
};

/// The stage equations (54) of a step of HBVM(k, s) over balls, in the bits of the BallScope.
class BallStages {
 public:
  /// The problem and the method must outlive it.
  BallStages(const BallProblem& problem, const BallMethod& method, RealBall h)
      : problem_(problem), method_(method), h_(std::move(h)) {}

  Index unknowns() const { return method_.s * (problem_.m() + problem_.nu()); }
  Index of_gamma(Index l, Index j) const { return l * problem_.m() + j; }
  Index of_lambda(Index l, Index a) const { return method_.s * problem_.m() + l * problem_.nu() + a; }

  StageImage image(const StageBox& box) const;
  StageDerivative derivative(const StageBox& box) const;
  /// The unknowns of the same polynomials the other way round. Those of a step from (q0, p0) to (q1, p1) become those
  /// of a step from (q1, -p1) to (q0, -p0).
  BallMatrix mirrored(const BallMatrix& unknowns) const;
  /// What (57) makes of the multipliers.
  std::vector<RealBall> multipliers_at_end(const BallMatrix& unknowns) const;

 private:
  /// u of (48) at a node, whose row of integrals that is.
  std::vector<BallSeries> position(const StageBox& box, const BallMatrix& I, Index node) const;
  /// M^-1 v at a node of the constraints.
  std::vector<RealBall> velocity(const StageBox& box, Index node) const;
  std::vector<RealBall> multipliers(const StageBox& box, Index node) const;
  /// By how much unknown l of the multipliers counts at a node.
  RealBall share(Index node, Index l) const;
  /// By how much a node counts in row l of the constraints.
  RealBall row_weight(Index l, Index node) const;

  /// Derivatives of psi - zeta by gamma, lambda and q0, and of the hidden constraints by gamma and q0.
  struct Parts {
    BallMatrix pull_by_gamma, pull_by_lambda, pull_by_q, hidden_by_gamma, hidden_by_q;
  };
  void add_forces(const StageBox& box, Parts& parts) const;
  void add_constraints(const StageBox& box, Parts& parts) const;

  const BallProblem& problem_;
  const BallMethod& method_;
  RealBall h_;
};

}  // namespace hbvm::core
