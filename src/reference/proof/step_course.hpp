#pragma once

#include <vector>

#include "scalar/arb.hpp"

namespace hbvm::core {

/// How far an exact motion may be from an approximate one.
struct ErrorDistance {
  RealBall length;  ///< of an error (dq, dv), squared dv^T M dv + omega^2 dq^T M dq
  double omega = 1;

  /// A bound of the same error. By omega' it is at most max(1, omega'/omega) times as long.
  ErrorDistance measured_by(double other) const;
};

/// The end of a part of a step, in units of the step's series, and what errors are measured by until then.
struct PieceEnd {
  RealBall end;
  double omega;
};

/// How errors grow over a step, piece by piece.
struct StepCourse {
  struct Piece {
    RealBall end;
    double omega;
    RealBall rate, defect;  ///< of errors, and of the approximate motion
    RealBall tube;          ///< what a distance is to stay below, measured by omega
  };
  std::vector<Piece> pieces;
  RealBall unit;      ///< of time
  double growth = 0;  ///< the natural logarithm of what errors may grow by

  /// The distance at s, from what it is at the start of the step.
  ErrorDistance distance_at(const RealBall& s, ErrorDistance before) const;
  /// Whether the distance is less than the tube's radius all the time.
  bool stays_in_tube(ErrorDistance before) const;
};

}  // namespace hbvm::core
