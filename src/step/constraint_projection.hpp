#pragma once

#include "linear/lu.hpp"
#include "linear/ordering.hpp"
#include "problem/driven_course.hpp"
#include "solver/stage_solver.hpp"

namespace hbvm::core {

/// Brings positions onto the constraints and momenta into their tangent spaces, as RATTLE does in every step. Owns its
/// storage. The problem must outlive it.
template <Scalar S>
class ConstraintProjection {
 public:
  explicit ConstraintProjection(const Problem<S>& problem);

  /// grad g(q0) gives the directions in which positions are moved.
  void set_directions(const Vector<S>& q0);
  ConstraintGradient<S>& directions() { return gradients_[now_]; }

  /// q = free + factor M^-1 grad g(q0) lambda with g(q) = 0: by Newton's iteration to round-off, from the lambda given.
  /// \return iterations \throws StageFailure if they do not converge
  long find_position(const Vector<S>& free, const S& factor, Matrix<S>& lambda, Vector<S>& q);

  /// Takes q for the position that was found.
  void set_position(const Vector<S>& q);
  /// p -= grad g(q) mu with grad g(q)^T M^-1 p = 0, at the position that was found last. \return mu
  /// \throws StageFailure if the gradients are linearly dependent there
  const Matrix<S>& make_tangential(Vector<S>& p) { return make_tangential(p, found()); }
  /// The same along the directions in which positions are moved: p -= grad g(q0) mu.
  const Matrix<S>& make_tangential_along_directions(Vector<S>& p) { return make_tangential(p, directions()); }

  /// That position's gradients are the next directions.
  void advance() { now_ = 1 - now_; }

  const std::vector<PartCount>& part_counts() const { return parts_; }

 private:
  enum Part { shifts, gradients, matrix, factors, solution, tangential };
  void describe_parts();
  const Matrix<S>& make_tangential(Vector<S>& p, ConstraintGradient<S>& along);
  /// x = (left^T M^-1 right)^-1 x. \return false if that is singular
  bool solve(ConstraintGradient<S>& left, const ConstraintGradient<S>& right, Matrix<S>& x);
  /// Whether g_ is what rounding makes of it at q: where lambda is nearly 0, its own digits say nothing.
  bool is_round_off(const Vector<S>& q);
  ConstraintGradient<S>& found() { return gradients_[1 - now_]; }

  const Problem<S>& problem_;
  ConstraintGradient<S> gradients_[2];
  int now_ = 0;  ///< which of them gives the directions
  Ordering order_;
  Lu<S> system_;
  Matrix<S> shift_, g_, mu_;  // 1 x nu
  Vector<S> v_;
  DrivenCourse<S> course_;  ///< at the position that was found last
  Vector<S> x_;
  S product_ = 0;  ///< of two gradients
  std::vector<PartCount> parts_;
};

}  // namespace hbvm::core
