#include "problem/force_slopes.hpp"

#include "linear/arrays.hpp"
#include "scalar/in_place.hpp"

namespace hbvm::core {
namespace {

template <Scalar S>
bool is_zero(const Program<S>& program, std::size_t output) {
  return program.is_constant(output) && program.constants()[program.output_operands()[output].index] == 0;
}

}  // namespace

template <Scalar S>
ForceSlopes<S>::ForceSlopes(const Problem<S>& problem, Index nodes) : nodes_(nodes) {
  const Index d = problem.dimension, bodies = problem.mass.of_bodies();
  std::map<std::pair<Index, Index>, Index> known;
  const auto pair_of = [&](Index row, Index column) {
    const auto [found, inserted] = known.try_emplace({row, column}, static_cast<Index>(pairs_.size()));
    if (inserted) pairs_.push_back({row, column});
    return found->second;
  };
  for (const ForceTerm<S>& term : problem.forces) {
    Work& work = work_.emplace_back(term, d, nodes);
    const Index inputs = term.arguments * d;
    for (Index n = 0; n < term.instances(); ++n)
      for (Index i = 0; i < term.acting * d; ++i)
        for (Index j = 0; j < 2 * inputs; ++j) {
          const Index output = i * 2 * inputs + j, argument = j % inputs;
          if (is_zero(term.slopes, static_cast<std::size_t>(output))) continue;
          for (const auto& a : term.displacement(n, i / d).blocks)
            for (const auto& b : term.displacement(n, argument / d).blocks)
              if (a.offset < bodies && b.offset < bodies)
                work.targets.push_back({pair_of(a.offset + i % d, b.offset + argument % d), output, n, j >= inputs,
                                        S(a.weight * b.weight)});
        }
  }
  by_position_ = by_velocity_ = Matrix<S>::Zero(nodes, static_cast<Index>(pairs_.size()));
}

template <Scalar S>
void ForceSlopes<S>::evaluate(Lanes<const S> q, Lanes<const S> v) {
  set_zero(by_position_);
  set_zero(by_velocity_);
  for (Work& work : work_) {
    work.inputs.update(q, v);
    work.slopes.run();
    for (const Target& target : work.targets)
      for (Index i = 0; i < nodes_; ++i) {
        const S& slope = work.slopes.output(target.output, target.instance * nodes_ + i);
        if (!is_finite(slope)) continue;
        S& sum = (target.velocity ? by_velocity_ : by_position_)(i, target.pair);
        add_product(sum, target.weight, slope, t_);
      }
  }
}

#define HBVM_DEFINE(S) template class ForceSlopes<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
