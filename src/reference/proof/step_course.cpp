#include "step_course.hpp"

namespace hbvm::core {
namespace {

/// The distance after so long a time in a piece, at any of the times in a ball.
ErrorDistance passed(ErrorDistance distance, const StepCourse::Piece& piece, const RealBall& time) {
  distance = distance.measured_by(piece.omega);
  // The defect grows with errors, or for a negative rate is there by itself.
  const RealBall factor = exponential(piece.rate * time);
  const RealBall of_defect = piece.defect * time * greater(RealBall(1), greatest_magnitude(factor));
  distance.length = greatest_magnitude(distance.length * factor + of_defect);
  return distance;
}

}  // namespace

ErrorDistance ErrorDistance::measured_by(double other) const {
  if (other <= omega) return {length, other};
  return {greatest_magnitude(length * exact_ball(other) / exact_ball(omega)), other};
}

ErrorDistance StepCourse::distance_at(const RealBall& s, ErrorDistance before) const {
  RealBall from;
  const RealBall latest = greatest_magnitude(s);
  for (const Piece& piece : pieces) {
    const bool last = !piece.end.is_below(latest);
    before = passed(before, piece, ((last ? s : piece.end) - from) * unit);
    if (last) break;
    from = piece.end;
  }
  return before;
}

bool StepCourse::stays_in_tube(ErrorDistance before) const {
  RealBall from;
  for (const Piece& piece : pieces) {
    // Between its ends it is no more than at one of them, and what the defect adds.
    const RealBall time = (piece.end - from) * unit;
    const RealBall at_start = before.measured_by(piece.omega).length;
    before = passed(before, piece, time);
    const RealBall most = greater(at_start, before.length) + piece.defect * time;
    if (!most.is_finite() || !most.is_below(piece.tube)) return false;
    from = piece.end;
  }
  return true;
}

}  // namespace hbvm::core
