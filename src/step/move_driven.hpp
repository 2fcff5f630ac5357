#pragma once

#include "problem/driven_course.hpp"
#include "scalar/in_place.hpp"
#include "step/state.hpp"

namespace hbvm::core {

/// Moves the driven points of a state on by h. \param course of one lane
template <Scalar S>
void move_driven(State<S>& state, const S& h, DrivenCourse<S>& course, const Problem<S>& problem) {
  if (course.empty()) return;
  const Index clock = problem.clock();
  // The carry keeps what rounding takes from the sum of the steps.
  S end = 0, rest = 0, t = 0;
  set_exact_sum(end, rest, state.q[clock], h, t);
  rest += state.q_carry[clock];
  set(course.time(0), end);
  course.evaluate();
  course.set_positions(lanes(state.q));
  for (Index j = clock; j < state.q.size(); ++j) set_zero(state.q_carry[j]);
  set(state.q_carry[clock], rest);
}

}  // namespace hbvm::core
