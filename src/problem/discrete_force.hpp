#pragma once

#include <deque>

#include "problem/effect/discrete_gradient.hpp"
#include "problem/potential.hpp"

namespace hbvm::core {

/// The discrete gradient of a potential, the sum of those of its effects: force . (q1 - q0) = U(q1) - U(q0) but for
/// round-off. Owns the storage, so that evaluating allocates nothing. The potential must outlive it.
template <Scalar S>
class DiscreteForce {
 public:
  explicit DiscreteForce(const Potential<S>& potential);

  /// force, 1 x m, overwritten.
  void evaluate(const Vector<S>& q0, const Vector<S>& q1, Matrix<S>& force);

  /// How often that of each effect was evaluated, all of them anew.
  const std::vector<EffectCount>& counts() const { return counts_; }

 private:
  struct Work {
    DiscreteGradient<S> gradient;
    Matrix<S> displacement;  ///< instances x twice the inputs: at q0, and at q1
    Execution<S> execution;
    Work(const EffectTerm<S>& term, Index dimension);
  };

  const Potential<S>& potential_;
  std::deque<Work> work_;  ///< of the effects whose force is not constant, in turn
  std::vector<EffectCount> counts_;
  Vector<S> constant_force_;
  S t_ = 0;  // scratch
};

}  // namespace hbvm::core
