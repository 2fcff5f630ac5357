#include "problem/curvature.hpp"

#include <algorithm>
#include <optional>

#include "linear/arrays.hpp"
#include "scalar/in_place.hpp"

namespace hbvm::core {

template <Scalar S>
template <class Column>
Curvature<S>::Term::Term(const EffectTerm<S>& term, Index dimension, Index nodes, Column column)
    : effect(&term),
      displacement(Matrix<S>::Zero(term.instances() * nodes, term.arguments * dimension)),
      hessian(term.hessian, term.hessian_coefficients, displacement, nodes) {
  const Index d = dimension, inputs = term.arguments * d;
  for (Index n = 0; n < term.instances(); ++n)
    for (Index i = 0; i < inputs; ++i)
      for (Index j = 0; j < inputs; ++j) {
        const Index high = std::max(i, j), low = std::min(i, j);
        for (const auto& a : term.displacement(n, i / d).blocks)
          for (const auto& b : term.displacement(n, j / d).blocks)
            if (const std::optional<Index> at = column(a.offset + i % d, b.offset + j % d))
              targets.push_back({*at, high * (high + 1) / 2 + low, n, S(a.weight * b.weight)});
      }
}

template <Scalar S>
void Curvature<S>::Term::add_to(Matrix<S>& values, Index dimension, Lanes<const S> q, S& t) {
  displace(*effect, dimension, q, displacement);
  hessian.run();
  const Index nodes = values.rows();
  for (const Target& target : targets)
    for (Index i = 0; i < nodes; ++i)
      add_product(values(i, target.column), target.weight, hessian.output(target.output, target.instance * nodes + i),
                  t);
}

template <Scalar S>
Index Curvature<S>::pair(Index row, Index column) {
  const auto [found, inserted] = known_.try_emplace({row, column}, static_cast<Index>(pairs_.size()));
  if (inserted) pairs_.push_back({row, column});
  return found->second;
}

template <Scalar S>
void Curvature<S>::add(Index constraint, Index row, Index column, const S& value) {
  if (value == 0 || column >= bodies_) return;
  const Index where = pair(row, column);
  for (auto entry = entries_.rbegin(); entry != entries_.rend() && entry->constraint == constraint; ++entry) {
    if (entry->pair != where) continue;
    entry->value += value;
    return;
  }
  entries_.push_back({constraint, where, value});
}

template <Scalar S>
Index Curvature<S>::varying_entry(Index constraint, Index pair) {
  for (std::size_t n = varying_entries_.size(); n-- > 0 && varying_entries_[n].constraint == constraint;)
    if (varying_entries_[n].pair == pair) return static_cast<Index>(n);
  varying_entries_.push_back({constraint, pair});
  return static_cast<Index>(varying_entries_.size()) - 1;
}

template <Scalar S>
Curvature<S>::Curvature(const Problem<S>& problem, Index nodes, Index constraint_nodes)
    : dimension_(problem.dimension), bodies_(problem.mass.of_bodies()) {
  const Index d = dimension_;
  for (const EffectTerm<S>& effect : problem.potential.terms)
    if (!effect.constant_force)
      terms_.emplace_back(effect, d, nodes, [&](Index row, Index column) -> std::optional<Index> {
        if (row >= bodies_ || column >= bodies_) return {};
        return pair(row, column);
      });
  for (Index c = 0; c < problem.nu(); ++c) {
    const auto add_entry = [&](Index row, Index column, const S& value) { add(c, row, column, value); };
    std::visit(
        [&]<class Form>(const Form& form) {
          if constexpr (ConstraintForm<Form, S>)
            form.second_derivatives(d, add_entry);
          else
            constraint_terms_.emplace_back(form.term, d, constraint_nodes,
                                           [&](Index row, Index column) -> std::optional<Index> {
                                             if (column >= bodies_) return {};
                                             return varying_entry(c, pair(row, column));
                                           });
        },
        problem.constraints[static_cast<std::size_t>(c)].form);
  }
  values_ = Matrix<S>::Zero(nodes, static_cast<Index>(pairs_.size()));
  varying_ = Matrix<S>::Zero(constraint_nodes, static_cast<Index>(varying_entries_.size()));
}

template <Scalar S>
const Matrix<S>& Curvature<S>::potential(Lanes<const S> q) {
  set_zero(values_);
  for (Term& term : terms_) term.add_to(values_, dimension_, q, t_);
  return values_;
}

template <Scalar S>
const Matrix<S>& Curvature<S>::varying(Lanes<const S> q) {
  set_zero(varying_);
  for (Term& term : constraint_terms_) term.add_to(varying_, dimension_, q, t_);
  return varying_;
}

#define HBVM_DEFINE(S) template class Curvature<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
