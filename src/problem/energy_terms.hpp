#pragma once

#include <deque>

#include "problem/problem.hpp"

namespace hbvm::core {

/// The energy of states, with what its round-off is proportional to. Owns its storage and allocates nothing after it
/// was made. The problem must outlive it.
template <Scalar S>
class EnergyTerms {
 public:
  explicit EnergyTerms(const Problem<S>& problem);

  void evaluate(const Vector<S>& q, const Vector<S>& p);
  /// H alone, at a third of the price; the sizes stay those of the last state evaluated.
  void evaluate_energy(const Vector<S>& q, const Vector<S>& p);

  /// H = 1/2 p^T M^-1 p - U(q), (1), less the work done: what StateEvaluator::balance is.
  const S& H() const { return H_; }
  /// The magnitudes of its terms: sum_j |p_j (M^-1 p)_j|/2 + sum |U| over the bodies and pairs of all effects.
  const S& size() const { return size_; }
  /// The size, and what H is sensitive to. For relative errors of p that is sum_j |p_j (M^-1 p)_j|. Every body and pair
  /// adds |dU/dx| times a length. That is |x| plus the magnitudes of the positions that the displacement x is the sum
  /// of. Times epsilon it is the round-off of H at a state of the working precision.
  const S& round_off_size() const { return round_off_size_; }
  /// Terms of the sum that H is.
  long count() const { return count_; }

 private:
  /// An effect in one lane.
  struct Work {
    const EffectTerm<S>& term;
    Matrix<S> displacement;  ///< instances x inputs
    Execution<S> value, gradient;
    Work(const EffectTerm<S>& effect, Index dimension);
  };

  /// Sets U_, and keeps the displacements of all effects.
  void evaluate_potential(const Vector<S>& q);

  const Problem<S>& problem_;
  std::deque<Work> work_;
  Vector<S> v_;
  long count_;
  S half_, U_ = 0, H_ = 0, size_ = 0, round_off_size_ = 0, t_ = 0, sum_ = 0;
};

}  // namespace hbvm::core
