#pragma once

#include <deque>

#include "problem/driven_course.hpp"
#include "problem/potential.hpp"

namespace hbvm::core {

/// Evaluates the forces that have no potential in a fixed number of lanes, and makes the driven coordinates' forces
/// powers. Owns its storage. The problem must outlive it.
template <Scalar S>
class ForceEvaluator {
 public:
  ForceEvaluator(const Problem<S>& problem, Index lanes);
  ForceEvaluator(const ForceEvaluator&) = delete;
  ForceEvaluator& operator=(const ForceEvaluator&) = delete;

  /// Makes of force = grad U what p' is without constraints, lanes x m. F is added. What is on driven coordinates is
  /// multiplied by their velocities. The powers F.v are taken from the accounts.
  /// \param course of the same lanes, with the driven coordinates as q and v have them
  void add(Lanes<const S> q, Lanes<const S> v, const DrivenCourse<S>& course, Matrix<S>& force);

  /// How often each force was evaluated.
  const std::vector<EffectCount>& counts() const { return counts_; }

 private:
  struct Work {
    const ForceTerm<S>& term;
    ForceInputs<S> inputs;
    Execution<S> force;
    Work(const ForceTerm<S>& of, Index dimension, Index lanes)
        : term(of), inputs(of, dimension, lanes), force(of.force, of.force_coefficients, inputs.values(), lanes) {}
  };

  Index d_, lanes_;
  std::deque<Work> work_;
  std::vector<EffectCount> counts_;
  S t_ = 0;  // scratch
};

}  // namespace hbvm::core
