#include "problem/discrete_force.hpp"

#include "clock.hpp"
#include "scalar/in_place.hpp"

namespace hbvm::core {

template <Scalar S>
DiscreteForce<S>::Work::Work(const EffectTerm<S>& term, Index dimension)
    : gradient(discrete_gradient(term, term.arguments * dimension)),
      displacement(Matrix<S>::Zero(term.instances(), 2 * term.arguments * dimension)),
      execution(gradient.program, gradient.coefficients, displacement, 1) {}

template <Scalar S>
DiscreteForce<S>::DiscreteForce(const Potential<S>& potential) : potential_(potential) {
  // A gradient that is the same everywhere is its own discrete gradient.
  const PotentialEvaluator<S> evaluator(potential, 1);
  counts_ = evaluator.counts();
  constant_force_ = evaluator.constant_force();
  const Index d = potential.dimension;
  for (std::size_t t = 0; t < potential.terms.size(); ++t) {
    const EffectTerm<S>& term = potential.terms[t];
    if (term.constant_force) continue;
    const Work& work = work_.emplace_back(term, d);
    OperationCounts& counts = counts_[t].per_evaluation = OperationCounts();
    for (const Displacement<S>& x : term.displacements) {
      counts += std::uint64_t{2} * operations(x, d);
      for (const auto& block : x.blocks) counts += weighted_sum(block.weight, d);
    }
    counts += static_cast<std::uint64_t>(term.instances()) * work.gradient.program.operations();
  }
}

template <Scalar S>
void DiscreteForce<S>::evaluate(const Vector<S>& q0, const Vector<S>& q1, Matrix<S>& force) {
  for (Index j = 0; j < force.cols(); ++j) set(force(0, j), constant_force_[j]);
  for (std::size_t t = 0, n = 0; t < potential_.terms.size(); ++t) {
    if (potential_.terms[t].constant_force) continue;
    const PartTimer timer(counts_[t].seconds);
    ++counts_[t].calls;
    ++counts_[t].evaluations;
    const EffectTerm<S>& term = potential_.terms[t];
    Work& work = work_[n++];
    const Index d = potential_.dimension, instances = work.displacement.rows(), inputs = term.arguments * d;
    displace(term, d, lanes(q0), work.displacement.data(), instances);
    displace(term, d, lanes(q1), work.displacement.data() + inputs * instances, instances);
    work.execution.run();
    for (Index i = 0; i < instances; ++i)
      for (Index j = 0; j < inputs; ++j)
        for (const auto& block : term.displacement(i, j / d).blocks)
          add_weighted(&force(0, block.offset + j % d), block.weight, &work.execution.output(j, i), Index{1}, t_);
  }
}

#define HBVM_DEFINE(S) template class DiscreteForce<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
