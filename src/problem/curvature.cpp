#include "hbvm/problem/curvature.hpp"

namespace hbvm {

Curvature::Term::Term(const EffectTerm<double>& term, Index dimension, Index nodes)
    : effect(&term),
      displacement(Matrix<double>::Zero(static_cast<Index>(term.displacements.size()) * nodes, dimension)),
      hessian(term.hessian, term.hessian_coefficients, displacement, nodes) {}

Index Curvature::pair(Index row, Index column) {
  const auto [found, inserted] = known_.try_emplace({row, column}, static_cast<Index>(pairs_.size()));
  if (inserted) pairs_.push_back({row, column});
  return found->second;
}

void Curvature::add(Index constraint, Index row, Index column, double value) {
  if (value == 0) return;
  const Index where = pair(row, column);
  for (auto entry = entries_.rbegin(); entry != entries_.rend() && entry->constraint == constraint; ++entry) {
    if (entry->pair != where) continue;
    entry->value += value;
    return;
  }
  entries_.push_back({constraint, where, value});
}

Curvature::Curvature(const Problem<double>& problem, Index nodes) : dimension_(problem.dimension), nodes_(nodes) {
  const Index d = dimension_;
  for (const EffectTerm<double>& effect : problem.potential.terms) {
    if (effect.constant_force) continue;
    Term& term = terms_.emplace_back(effect, d, nodes);
    for (std::size_t n = 0; n < effect.displacements.size(); ++n) {
      const auto& blocks = effect.displacements[n].blocks;
      for (const auto& a : blocks)
        for (const auto& b : blocks)
          for (Index i = 0; i < d; ++i)
            for (Index j = 0; j < d; ++j) {
              const Index high = std::max(i, j), low = std::min(i, j);
              term.targets.push_back({pair(a.offset + i, b.offset + j), high * (high + 1) / 2 + low,
                                      static_cast<Index>(n), a.weight * b.weight});
            }
    }
  }
  for (Index c = 0; c < problem.nu(); ++c) {
    const auto& form = problem.constraints[static_cast<std::size_t>(c)].form;
    if (const auto* product = std::get_if<DisplacementProduct<double>>(&form)) {
      for (const auto& a : product->x.blocks)
        for (const auto& b : (product->same ? product->x : product->y).blocks)
          for (Index i = 0; i < d; ++i) {
            add(c, a.offset + i, b.offset + i, a.weight * b.weight);
            add(c, b.offset + i, a.offset + i, a.weight * b.weight);
          }
    }
    if (const auto* quadric = std::get_if<Quadric<double>>(&form)) {
      for (Index i = 0; i < quadric->b.size(); ++i)
        for (Index j = 0; j < quadric->b.size(); ++j)
          add(c, quadric->offset + i, quadric->offset + j, 2 * quadric->A(i, j));
    }
  }
  values_ = Matrix<double>::Zero(nodes, static_cast<Index>(pairs_.size()));
}

const Matrix<double>& Curvature::potential(Lanes<const double> q) {
  values_.setZero();
  for (Term& term : terms_) {
    double* out = term.displacement.data();
    for (const auto& x : term.effect->displacements) {
      displace(x, dimension_, q, out, term.displacement.rows());
      out += nodes_;
    }
    term.hessian.run();
    for (const auto& target : term.targets)
      for (Index i = 0; i < nodes_; ++i)
        values_(i, target.pair) += target.weight * term.hessian.output(target.output, target.instance * nodes_ + i);
  }
  return values_;
}

}  // namespace hbvm
