#pragma once

#include <deque>
#include <map>

#include "problem/effect/execution.hpp"
#include "problem/problem.hpp"

namespace hbvm::core {

/// The derivatives of the forces that have no potential by positions and velocities, for the pairs of coordinates of
/// bodies where they can be nonzero. One that is not finite, as that of |v| v by v at rest, is taken for 0. They lead
/// an iteration, and are no part of its solution. The problem must outlive it.
template <Scalar S>
class ForceSlopes {
 public:
  ForceSlopes(const Problem<S>& problem, Index nodes);
  ForceSlopes(const ForceSlopes&) = delete;
  ForceSlopes& operator=(const ForceSlopes&) = delete;

  /// dF_row by q_column and v_column.
  struct Pair {
    Index row, column;
  };
  const std::vector<Pair>& pairs() const { return pairs_; }

  void evaluate(Lanes<const S> q, Lanes<const S> v);
  /// nodes x pairs, after evaluate().
  const Matrix<S>& by_position() const { return by_position_; }
  const Matrix<S>& by_velocity() const { return by_velocity_; }

 private:
  struct Target {
    Index pair, output, instance;
    bool velocity;
    S weight;
  };
  struct Work {
    ForceInputs<S> inputs;
    Execution<S> slopes;
    std::vector<Target> targets;
    Work(const ForceTerm<S>& term, Index dimension, Index nodes)
        : inputs(term, dimension, nodes), slopes(term.slopes, term.slope_coefficients, inputs.values(), nodes) {}
  };

  Index nodes_;
  std::vector<Pair> pairs_;
  std::deque<Work> work_;
  Matrix<S> by_position_, by_velocity_;
  S t_ = 0;
};

}  // namespace hbvm::core
