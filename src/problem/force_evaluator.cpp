#include "problem/force_evaluator.hpp"

#include "clock.hpp"

namespace hbvm::core {

template <Scalar S>
ForceEvaluator<S>::ForceEvaluator(const Problem<S>& problem, Index lanes) : d_(problem.dimension), lanes_(lanes) {
  for (const ForceTerm<S>& term : problem.forces) {
    work_.emplace_back(term, d_, lanes);
    OperationCounts& counts = counts_.emplace_back().per_evaluation;
    const Index outputs = term.instances() * term.acting * d_;
    for (const Displacement<S>& x : term.displacements) counts += std::uint64_t{2} * operations(x, d_);
    counts += static_cast<std::uint64_t>(term.instances()) * term.force.operations();
    counts.add_products(term.account ? outputs : 0);
    counts.add(Op::add, outputs);
  }
}

template <Scalar S>
void ForceEvaluator<S>::add(Lanes<const S> q, Lanes<const S> v, const DrivenCourse<S>& course, Matrix<S>& force) {
  for (std::size_t n = 0; n < work_.size(); ++n) {
    const PartTimer timer(counts_[n].seconds);
    ++counts_[n].calls;
    counts_[n].evaluations += static_cast<std::uint64_t>(lanes_);
    Work& work = work_[n];
    work.inputs.update(q, v);
    work.force.run();
    for (Index i = 0; i < work.term.instances(); ++i)
      for (Index j = 0; j < work.term.acting * d_; ++j)
        for (const auto& block : work.term.displacement(i, j / d_).blocks) {
          S* const column = &force(0, block.offset + j % d_);
          for (Index lane = 0; lane < lanes_; ++lane)
            add_weighted(column + lane, block.weight, &work.force.output(j, i * lanes_ + lane), Index{1}, t_);
        }
  }
  if (course.empty()) return;
  course.make_powers(lanes(force));
  for (Work& work : work_) {
    if (!work.term.account) continue;
    const Index rates = work.term.arguments * d_;
    for (Index i = 0; i < work.term.instances(); ++i)
      for (Index j = 0; j < work.term.acting * d_; ++j)
        for (Index lane = 0; lane < lanes_; ++lane) {
          S& account = force(lane, *work.term.account);
          const Index row = i * lanes_ + lane;
          set_product(t_, work.force.output(j, row), work.inputs.values()(row, rates + j));
          set_difference(account, account, t_);
        }
  }
}

#define HBVM_DEFINE(S) template class ForceEvaluator<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
