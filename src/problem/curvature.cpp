#include "hbvm/problem/curvature.hpp"

#include "hbvm/linear/arrays.hpp"
#include "hbvm/scalar/in_place.hpp"

namespace hbvm {

template <Scalar S>
Curvature<S>::Term::Term(const EffectTerm<S>& term, Index dimension, Index nodes)
    : effect(&term),
      displacement(Matrix<S>::Zero(term.instances() * nodes, term.arguments * dimension)),
      hessian(term.hessian, term.hessian_coefficients, displacement, nodes) {}

template <Scalar S>
Index Curvature<S>::pair(Index row, Index column) {
  const auto [found, inserted] = known_.try_emplace({row, column}, static_cast<Index>(pairs_.size()));
  if (inserted) pairs_.push_back({row, column});
  return found->second;
}

template <Scalar S>
void Curvature<S>::add(Index constraint, Index row, Index column, const S& value) {
  if (value == 0) return;
  const Index where = pair(row, column);
  for (auto entry = entries_.rbegin(); entry != entries_.rend() && entry->constraint == constraint; ++entry) {
    if (entry->pair != where) continue;
    entry->value += value;
    return;
  }
  entries_.push_back({constraint, where, value});
}

template <Scalar S>
Curvature<S>::Curvature(const Problem<S>& problem, Index nodes) : dimension_(problem.dimension), nodes_(nodes) {
  const Index d = dimension_;
  for (const EffectTerm<S>& effect : problem.potential.terms) {
    if (effect.constant_force) continue;
    Term& term = terms_.emplace_back(effect, d, nodes);
    const Index inputs = effect.arguments * d;
    for (Index n = 0; n < effect.instances(); ++n)
      for (Index i = 0; i < inputs; ++i)
        for (Index j = 0; j < inputs; ++j) {
          const Index high = std::max(i, j), low = std::min(i, j);
          for (const auto& a : effect.displacement(n, i / d).blocks)
            for (const auto& b : effect.displacement(n, j / d).blocks)
              term.targets.push_back(
                  {pair(a.offset + i % d, b.offset + j % d), high * (high + 1) / 2 + low, n, S(a.weight * b.weight)});
        }
  }
  for (Index c = 0; c < problem.nu(); ++c) {
    const auto add_entry = [&](Index row, Index column, const S& value) { add(c, row, column, value); };
    std::visit([&](const auto& form) { form.second_derivatives(d, add_entry); },
               problem.constraints[static_cast<std::size_t>(c)].form);
  }
  values_ = Matrix<S>::Zero(nodes, static_cast<Index>(pairs_.size()));
}

template <Scalar S>
const Matrix<S>& Curvature<S>::potential(Lanes<const S> q) {
  set_zero(values_);
  for (Term& term : terms_) {
    displace(*term.effect, dimension_, q, term.displacement.data(), term.displacement.rows());
    term.hessian.run();
    for (const auto& target : term.targets)
      for (Index i = 0; i < nodes_; ++i)
        add_product(values_(i, target.pair), target.weight,
                    term.hessian.output(target.output, target.instance * nodes_ + i), t_);
  }
  return values_;
}

#define HBVM_DEFINE(S) template class Curvature<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm
