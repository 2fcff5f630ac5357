#pragma once

#include <deque>

#include "problem/effect/execution.hpp"
#include "problem/problem.hpp"

namespace hbvm::core {

/// Where the driven points of a problem are at some times, a lane each, with their velocities and accelerations. Owns
/// its storage. The problem must outlive it. Where no point is driven all of it does nothing.
template <Scalar S>
class DrivenCourse {
 public:
  DrivenCourse(const Problem<S>& problem, Index lanes);
  DrivenCourse(const DrivenCourse&) = delete;
  DrivenCourse& operator=(const DrivenCourse&) = delete;

  bool empty() const { return points_.empty(); }
  /// The time of a lane, to be set before evaluate().
  S& time(Index lane) { return times_(lane, 0); }
  void evaluate();

  /// Sets the driven coordinates of all lanes.
  void set_positions(Lanes<S> q) const { set_outputs(q, 0); }
  void set_velocities(Lanes<S> v) const { set_outputs(v, 1); }
  void set_accelerations(Lanes<S> a) const { set_outputs(a, 2); }
  /// Multiplies the forces on the driven coordinates by their velocities, which makes powers of them.
  void make_powers(Lanes<S> force) const;

 private:
  void set_outputs(Lanes<S> to, Index derivative) const;

  Index first_, d_;
  Matrix<S> times_;  ///< lanes x 1
  std::deque<Execution<S>> points_;
};

/// The coordinates of bodies, and driven ones as they are at t.
template <Scalar S>
Vector<S> with_driven(const Problem<S>& problem, const Vector<S>& of_bodies, const S& t) {
  Vector<S> all = Vector<S>::Zero(problem.m());
  all.head(of_bodies.size()) = of_bodies;
  DrivenCourse<S> course(problem, 1);
  if (course.empty()) return all;
  course.time(0) = t;
  course.evaluate();
  course.set_positions(lanes(all));
  return all;
}

/// The course at the time that q says, of one lane.
template <Scalar S>
void place(DrivenCourse<S>& course, const Problem<S>& problem, const Vector<S>& q) {
  if (course.empty()) return;
  set(course.time(0), q[problem.clock()]);
  course.evaluate();
}

}  // namespace hbvm::core
