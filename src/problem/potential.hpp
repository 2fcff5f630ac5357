#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "problem/effect/execution.hpp"
#include "problem/effect/joint_program.hpp"
#include "problem/effect/kernel.hpp"
#include "problem/effect/term.hpp"

namespace hbvm::core {

/// How often the force of an effect ran. It has calls, evaluations at a node (each for all bodies or pairs it acts on),
/// and the operations of one evaluation by its formula. Of these some are not done again where an effect before it has
/// done them. `seconds` is measured while a MeasuredParts lives.
struct EffectCount {
  std::uint64_t calls = 0, evaluations = 0;
  OperationCounts per_evaluation{}, done_before{};
  double seconds = 0;

  /// The operations that an evaluation takes.
  OperationCounts done() const { return per_evaluation - done_before; }

  template <class Archive>
  void remember(Archive& archive) {
    archive(calls, evaluations, per_evaluation, done_before, seconds);
  }
};

/// U(q) of (1), H = 1/2 p^T M^-1 p - U(q), as the sum of the effects a scene names.
template <Scalar S>
struct Potential {
  Index dimension = 0;  ///< 2 or 3
  Index m = 0;          ///< coordinates
  std::vector<EffectTerm<S>> terms;
};

/// Evaluates a potential in a fixed number of lanes; owns the storage that takes, so that evaluating allocates
/// nothing. One evaluator per thread. The potential must outlive it. What effects that act alike have in common, as a
/// distance, is computed once: it is the first one's.
template <Scalar S>
class PotentialEvaluator {
 public:
  PotentialEvaluator(const Potential<S>& potential, Index lanes);
  PotentialEvaluator(const PotentialEvaluator&) = delete;
  PotentialEvaluator& operator=(const PotentialEvaluator&) = delete;

  /// U in each lane.
  void values(Lanes<const S> q, Vector<S>& U);

  /// The part of grad U that is the same everywhere: computed once, m entries.
  const Vector<S>& constant_force() const { return constant_force_; }
  bool has_varying_force() const { return !varying_.empty(); }
  /// force = the part of grad U that varies with q: lanes x m, overwritten.
  void varying_force(Lanes<const S> q, Matrix<S>& force);
  /// force = grad U: lanes x m, overwritten.
  void force(Lanes<const S> q, Matrix<S>& force);

  /// How often the force of each term was evaluated.
  const std::vector<EffectCount>& counts() const { return counts_; }

 private:
  struct Work {
    Matrix<S> displacement;  ///< (instances * lanes) x inputs: all lanes of one instance, then the next
    Execution<S> value;
    std::optional<KernelUse> kernel;  ///< the gradient compiled, in double, if the library has it
    Work(const EffectTerm<S>& term, Index dimension, Index lanes);
  };

  /// The gradients of terms that act alike, with the displacements of the first.
  struct Joint {
    JointProgram<S> code;
    Execution<S> gradient;
    std::optional<KernelUse> kernel;  ///< of all of them, likewise
    Joint(const std::vector<const EffectTerm<S>*>& terms, const Matrix<S>& displacement, Index lanes);
  };
  /// A term whose force varies.
  struct Varying {
    const EffectTerm<S>* term;
    Work* work;
    EffectCount* count;
    Joint* joint = nullptr;          ///< none where its own kernel serves
    std::size_t first = 0, end = 0;  ///< its instructions
    Index output = 0;                ///< its first one
  };

  /// Joins the gradients of the terms that vary and act alike; those that have kernels if they have one together.
  void join_gradients();
  /// Those with a kernel together are evaluated one by one from here on: each has a time of its own.
  void take_apart();
  /// force += the gradient of a term.
  void add_force(const Varying& own, Lanes<const S> q, Matrix<S>& force);
  /// f(output of the gradient, instance, coordinate whose force it is part of, weight), for all of them.
  template <class F>
  void for_each_force(const EffectTerm<S>& term, F f) const;

  const Potential<S>& potential_;
  Index lanes_;
  std::deque<Work> work_;
  std::deque<Joint> joints_;
  std::vector<EffectCount> counts_;
  std::vector<Varying> varying_;
  Vector<S> constant_force_;
  S t_;  // scratch
};

}  // namespace hbvm::core
