#include "problem/energy_terms.hpp"

#include "scalar/in_place.hpp"

namespace hbvm::core {
namespace {

/// sum += |a|.
template <Scalar S>
void add_magnitude(S& sum, const S& a) {
  if (a < 0)
    set_difference(sum, sum, a);
  else
    set_sum(sum, sum, a);
}

}  // namespace

template <Scalar S>
EnergyTerms<S>::Work::Work(const EffectTerm<S>& effect, Index dimension)
    : term(effect),
      displacement(Matrix<S>::Zero(effect.instances(), effect.arguments * dimension)),
      value(effect.value, effect.value_coefficients, displacement, 1),
      gradient(effect.gradient, effect.gradient_coefficients, displacement, 1) {}

template <Scalar S>
EnergyTerms<S>::EnergyTerms(const Problem<S>& problem)
    : problem_(problem), v_(problem.m()), count_(problem.m()), half_(S(1) / 2) {
  for (const EffectTerm<S>& term : problem.potential.terms) {
    work_.emplace_back(term, problem.dimension);
    count_ += static_cast<long>(term.instances());
  }
}

template <Scalar S>
void EnergyTerms<S>::evaluate_potential(const Vector<S>& q) {
  set_zero(U_);
  for (Work& work : work_) {
    displace(work.term, problem_.dimension, lanes(q), work.displacement);
    work.value.run();
    for (Index n = 0; n < work.displacement.rows(); ++n) set_sum(U_, U_, work.value.output(0, n));
  }
}

template <Scalar S>
void EnergyTerms<S>::evaluate_energy(const Vector<S>& q, const Vector<S>& p) {
  problem_.mass.velocity(lanes(p), lanes(v_));
  evaluate_potential(q);
  set_zero(H_);
  for (Index j = 0; j < p.size(); ++j) add_product(H_, p[j], v_[j], t_);
  set_product(H_, H_, half_);
  set_difference(H_, H_, U_);
  for (Index j = problem_.mass.of_bodies(); j < p.size(); ++j) set_sum(H_, H_, p[j]);
}

template <Scalar S>
void EnergyTerms<S>::evaluate(const Vector<S>& q, const Vector<S>& p) {
  evaluate_energy(q, p);
  set_zero(round_off_size_);
  for (Index j = 0; j < p.size(); ++j) {
    set_product(t_, p[j], v_[j]);
    add_magnitude(round_off_size_, t_);
  }
  set_product(size_, round_off_size_, half_);
  for (Index j = problem_.mass.of_bodies(); j < p.size(); ++j) add_magnitude(size_, p[j]);
  for (Work& work : work_) {
    work.gradient.run();
    for (Index n = 0; n < work.displacement.rows(); ++n) {
      add_magnitude(size_, work.value.output(0, n));
      for (Index j = 0; j < work.displacement.cols(); ++j) {
        set_zero(sum_);
        add_magnitude(sum_, work.displacement(n, j));
        for (const auto& block : work.term.displacement(n, j / problem_.dimension).blocks) {
          set_product(t_, block.weight, q[block.offset + j % problem_.dimension]);
          add_magnitude(sum_, t_);
        }
        set_product(t_, work.gradient.output(j, n), sum_);
        add_magnitude(round_off_size_, t_);
      }
    }
  }
  set_sum(round_off_size_, round_off_size_, size_);
}

#define HBVM_DEFINE(S) template class EnergyTerms<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
