#pragma once

#include <vector>

#include "ball_problem.hpp"

namespace hbvm::core {

/// An approximate motion over one step: polynomials with exact coefficients for the positions and the multipliers, in
/// the time s = (t - start) / h. The velocities are the derivatives of the positions, exactly. The unit h and the end
/// of the step are exact, too.
class SeriesStep {
 public:
  /// \param end  in units
  SeriesStep(std::vector<BallSeries> q, std::vector<BallSeries> lambda, const RealBall& unit, const RealBall& end,
             Index order);

  const std::vector<BallSeries>& q() const { return q_; }
  /// h v, where v is the velocity.
  const std::vector<BallSeries>& scaled_v() const { return v_; }
  const std::vector<BallSeries>& lambda() const { return lambda_; }
  /// The unit of time h, and the end of the step in units.
  const RealBall& unit() const { return unit_; }
  const RealBall& end() const { return end_; }
  /// The time of the end, exactly, from that of the start.
  RealBall end_time(RealBall start) const;
  /// So many coefficients of a force along the positions balance those of the acceleration.
  Index order() const { return order_; }

  std::vector<RealBall> positions(const RealBall& s) const { return at(q_, s); }
  std::vector<RealBall> velocities(const RealBall& s) const;
  std::vector<RealBall> accelerations(const RealBall& s) const;
  /// The same step with as many bits as the scope has, for times from its start to its end.
  SeriesStep rounded() const;

 private:
  static std::vector<RealBall> at(const std::vector<BallSeries>& series, const RealBall& s);

  std::vector<BallSeries> q_, v_, a_, lambda_;
  RealBall unit_, end_;
  Index order_;
};

}  // namespace hbvm::core
