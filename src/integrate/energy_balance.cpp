#include "integrate/energy_balance.hpp"

#include "linear/product.hpp"
#include "scalar/in_place.hpp"

namespace hbvm::core {

template <Scalar S>
EnergyBalance<S>::EnergyBalance(const Problem<S>& problem)
    : problem_(problem), U_(1), q_(problem.m()), count_(problem.m()) {
  const Potential<S>& all = problem.potential;
  for (const EffectTerm<S>& term : all.terms) {
    effects_.push_back({all.dimension, all.m, {term}});
    values_.emplace_back(effects_.back(), 1);
    count_ += static_cast<long>(term.instances());
  }
}

template <Scalar S>
void EnergyBalance<S>::observe(const Vector<S>& v, const Snapshot<S>& snapshot) {
  H_ = dot(snapshot.p, v) / 2;
  raise_magnitude(size_, H_);
  set(kinetic_, H_);
  for (PotentialEvaluator<S>& effect : values_) {
    effect.values(lanes(snapshot.q), U_);
    raise_magnitude(size_, U_[0]);
    set_difference(H_, H_, U_[0]);
  }
  for (Index j = problem_.clock(); j < snapshot.p.size(); ++j) {
    raise_magnitude(size_, snapshot.p[j]);
    set_sum(H_, H_, snapshot.p[j]);
  }
  if (snapshot.n == 0) {
    set(H0_, H_);
    q_ = snapshot.q;
  }
  set_difference(H_, H_, H0_);
  change_.observe(kinetic_, H_, snapshot.t);
  if (!exceeds(H_, error_)) return;
  error_ = magnitude(H_);
  q_ = snapshot.q;
  set(t_, snapshot.t);
}

template <Scalar S>
S EnergyBalance<S>::rounding() {
  PotentialEvaluator<S> potential(problem_.potential, 1);
  Matrix<S> force;
  potential.force(lanes(q_), force);
  S sum = 0;
  for (Index j = 0; j < problem_.m(); ++j) sum += magnitude(S(q_[j] * force(0, j)));
  return sum > size_ ? sum : size_;
}

#define HBVM_DEFINE(S) template class EnergyBalance<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
