#pragma once

#include <vector>

#include "reference/between/force_bounds.hpp"
#include "series_step.hpp"

namespace hbvm::core {

/// By how much an approximate motion fails the equations over a step: upper bounds at all its times.
struct Defect {
  /// The length of e = M q'' - grad U(q) + grad g(q) lambda, in the metric M^-1.
  RealBall force;
  /// |d^2/dt^2 g(q)|, of each constraint.
  std::vector<RealBall> bending;
};

/// Bounds of defects. The first coefficients of a defect's power series are computed as balls. The others are bounded
/// by Cauchy's estimate. Of a function that is analytic in |s| <= R, and at most B there, coefficient n is at most
/// B / R^n. That the forces are analytic there, and how large they are, is found by ForceBounds.
class DefectBound {
 public:
  /// Both must outlive it.
  /// \param problem the one that `balls` are made of
  DefectBound(const BallProblem& balls, const Problem<Mpfr>& problem);

  /// \param q, p  where the step starts, roughly
  /// \throws IntegrationError if the forces are not analytic or too large on a circle about the start of the step
  Defect of(const SeriesStep& step, const Vector<Mpfr>& q, const Vector<Mpfr>& p);

 private:
  /// The circle |s| = R, and what is beyond the order of a function that is at most 1 on it.
  struct Circle {
    double log2_radius;
    RealBall radius, tail, tail_of_derivative;
  };
  Circle circle_of(const SeriesStep& step) const;
  /// Bounds on the circle of the outputs of the gradients, force by force.
  std::vector<std::vector<RealBall>> bounds_on(const Circle& circle, const SeriesStep& step, double log2_length);

  const BallProblem& balls_;
  ForceBounds bounds_;
};

}  // namespace hbvm::core
