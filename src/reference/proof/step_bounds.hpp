#pragma once

#include <functional>
#include <vector>

#include "defect.hpp"
#include "error_growth.hpp"
#include "proved_step.hpp"
#include "scene/assemble.hpp"

namespace hbvm::core {

/// The state at a time, each component between bounds that are proved.
struct ProvedState {
  std::vector<RealBall> q, p, lambda;
  RealBall H;
};

/// What can be shown of one step of an approximate motion, whoever made it. Its state changes with use: each thread has
/// its own.
class StepBounds {
 public:
  /// In the digits of the scope.
  /// \param exact  the scene assembled with at least twice the digits, which outlives this
  /// \param while_working is called many times a step, and may throw to end the work
  StepBounds(const Assembled<Mpfr>& exact, std::function<void()> while_working);

  const BallProblem& problem() const { return balls_; }
  /// Of centres.
  slong bits() const { return bits_; }

  /// \throws IntegrationError if the forces are not analytic or too large about the step
  Defect defect(const SeriesStep& step);
  /// The growth of errors in a tube of that radius. \throws IntegrationError if there is no bound
  StepCourse course(const SeriesStep& step, const Defect& defect, const ErrorDistance& tube,
                    const std::vector<PieceEnd>& pieces) const;

  /// How far the start of the scene is from the start of a step.
  RealBall distance_of_start(const SeriesStep& step, double omega) const;
  /// How far the end of a step is from the start of the next.
  RealBall jump(const SeriesStep& step, const SeriesStep& next, double omega) const;
  /// Where the exact motion is at s, if it is no farther away than that.
  ProvedState state(const SeriesStep& step, const RealBall& s, const ErrorDistance& distance) const;
  /// The size of a state, by which round-off of a distance is measured.
  RealBall size_at_start(const SeriesStep& step, double omega) const;

 private:
  PathBox box(const SeriesStep& step, const RealBall& s, const ErrorDistance& distance) const;

  const Assembled<Mpfr>& exact_;
  slong bits_;
  BallProblem balls_;
  DefectBound bound_;
  ErrorGrowthIn growth_in_;
  std::function<void()> while_working_;
};

/// A bound, rounded up to a short number. It is a little more, so that another way of rounding shows it, too.
RealBall rounded_up(const RealBall& bound);

}  // namespace hbvm::core
