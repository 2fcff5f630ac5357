#include "hbvm/integrate/rattle.hpp"

#include "hbvm/scalar/in_place.hpp"
#include "hbvm/scalar/text.hpp"

namespace hbvm {

template <Scalar S>
Rattle<S>::Rattle(const Problem<S>& problem, const S& step)
    : problem_(problem),
      h_(step),
      half_(step / 2),
      potential_(problem.potential, 1),
      gradients_{{problem, 1}, {problem, 1}},
      force_(Matrix<S>::Zero(1, problem.m())),
      lambda_(Matrix<S>::Zero(1, problem.nu())),
      mu_(lambda_),
      g_(lambda_),
      free_(problem.m()),
      q_(problem.m()),
      p_(problem.m()),
      v_(problem.m()),
      x_(problem.nu()) {
  std::vector<std::pair<Index, Index>> entries;
  for (const auto& pair : gradients_[0].couplings()) entries.emplace_back(pair.a, pair.b);
  order_ = order_for_band(problem.nu(), entries);
  system_.resize(problem.nu(), order_.half_bandwidth);
}

template <Scalar S>
void Rattle<S>::force(const Vector<S>& q) {
  if (potential_.has_varying_force())
    potential_.varying_force(lanes(q), force_);
  else
    for (Index j = 0; j < force_.size(); ++j) set_zero(force_.data()[j]);
  const Vector<S>& constant = potential_.constant_force();
  for (Index j = 0; j < force_.size(); ++j) set_sum(force_.data()[j], force_.data()[j], constant[j]);
}

template <Scalar S>
bool Rattle<S>::solve(ConstraintGradient<S>& left, const ConstraintGradient<S>& right, Matrix<S>& x) {
  const auto place = [&](Index a) { return order_.position[static_cast<std::size_t>(a)]; };
  system_.set_zero();
  for (const auto& pair : left.couplings()) left.coupling(pair, right, &system_.entry(place(pair.a), place(pair.b)));
  if (!system_.factor()) return false;
  for (Index a = 0; a < x.size(); ++a) set(x_[place(a)], x.data()[a]);
  system_.solve(x_);
  for (Index a = 0; a < x.size(); ++a) set(x.data()[a], x_[place(a)]);
  return true;
}

template <Scalar S>
long Rattle<S>::step(State<S>& state) {
  constexpr long max_iterations = 50;
  const Index m = problem_.m(), nu = problem_.nu();
  ConstraintGradient<S>& before = gradients_[now_];
  ConstraintGradient<S>& after = gradients_[1 - now_];
  if (!started_) {
    force(state.q);
    before.update(lanes(std::as_const(state.q)));
    started_ = true;
  }
  // Without multipliers, p + h/2 grad U and q + h M^-1 (p + h/2 grad U); each multiplier then moves q by
  // -h^2/2 M^-1 grad g lambda.
  for (Index j = 0; j < m; ++j) {
    set_product(p_[j], half_, force_(0, j));
    set_sum(p_[j], p_[j], state.p[j]);
  }
  problem_.mass.velocity(lanes(std::as_const(p_)), lanes(v_));
  for (Index j = 0; j < m; ++j) {
    set_product(free_[j], h_, v_[j]);
    set_sum(free_[j], free_[j], state.q[j]);
  }
  const S factor = -h_ * half_;
  long iterations = 0;
  S last = 0, increment = 0, size = 0;
  for (bool found = nu == 0;;) {
    for (Index a = 0; a < nu; ++a) set_product(mu_.data()[a], factor, lambda_.data()[a]);
    for (Index j = 0; j < m; ++j) set(q_[j], free_[j]);
    before.add_weighted_times(mu_, lanes(q_));
    after.update(lanes(std::as_const(q_)), g_);
    if (found) break;
    for (Index a = 0; a < nu; ++a) set(mu_.data()[a], g_.data()[a]);
    if (!solve(after, before, mu_) || ++iterations > max_iterations)
      throw StageFailure(FailureCause::stage_equations_diverge, "the positions of a RATTLE step were not found",
                         to_scientific(increment, 3), iterations);
    using std::swap;
    swap(last, increment);
    set_zero(increment);
    set_zero(size);
    for (Index a = 0; a < nu; ++a) {
      set_quotient(mu_.data()[a], mu_.data()[a], factor);
      set_difference(lambda_.data()[a], lambda_.data()[a], mu_.data()[a]);
      raise_to(increment, magnitude(mu_.data()[a]));
      raise_to(size, magnitude(lambda_.data()[a]));
    }
    // Convergence is quadratic: the next increment is this one times the square of the factor it fell by.
    const bool falls = iterations > 1 && 2 * increment < last;
    const S ratio = falls ? S(increment / last) : S(1);
    found = increment * ratio * ratio <= size * epsilon<S>() / 8 ||
            (iterations > 1 && !falls && increment <= size * S(16 * (m + nu)) * epsilon<S>());
  }

  force(q_);
  for (Index j = 0; j < m; ++j) {
    set_product(v_[j], half_, force_(0, j));
    set_sum(p_[j], p_[j], v_[j]);
  }
  for (Index a = 0; a < nu; ++a) {
    set_product(mu_.data()[a], half_, lambda_.data()[a]);
    set_negative(mu_.data()[a], mu_.data()[a]);
  }
  before.add_times(mu_, lanes(p_));
  if (nu > 0) {
    problem_.mass.velocity(lanes(std::as_const(p_)), lanes(v_));
    for (Index a = 0; a < nu; ++a) after.transposed_times(a, lanes(std::as_const(v_)), &mu_(0, a));
    if (!solve(after, after, mu_))
      throw StageFailure(FailureCause::near_singular_constraints, "the constraints' gradients are linearly dependent",
                         to_scientific(increment, 3), iterations);
    for (Index a = 0; a < nu; ++a) set_negative(mu_.data()[a], mu_.data()[a]);
    after.add_times(mu_, lanes(p_));
  }
  state.q.swap(q_);
  state.p.swap(p_);
  now_ = 1 - now_;
  return iterations;
}

#define HBVM_DEFINE(S) template class Rattle<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm
