#include "hbvm/step/rattle.hpp"

#include "hbvm/linear/arrays.hpp"
#include "hbvm/scalar/in_place.hpp"
#include "hbvm/scalar/text.hpp"

namespace hbvm {

template <Scalar S>
Rattle<S>::Rattle(const Problem<S>& problem)
    : problem_(problem),
      one_half_(S(1) / 2),
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
      x_(problem.nu()),
      multiplier_(Vector<S>::Zero(problem.nu())),
      arrived_(problem.m()) {
  std::vector<std::pair<Index, Index>> entries;
  for (const auto& pair : gradients_[0].couplings()) entries.emplace_back(pair.a, pair.b);
  order_ = order_for_band(problem.nu(), entries);
  system_.resize(problem.nu(), order_.half_bandwidth);
  describe_parts();
}

template <Scalar S>
void Rattle<S>::describe_parts() {
  const Index m = problem_.m(), nu = problem_.nu(), stored = gradients_[0].stored(),
              weighted = gradients_[0].weighted_values().cols();
  parts_ = {{"half kicks and drift"}, {"positions"}, {"constraint gradients"}, {"matrix of multipliers"},
            {"factors of it"},        {"solution"},  {"tangential momenta"}};
  parts_[kicks].per_call = problem_.mass.operations();
  parts_[kicks].per_call.add_products(3 * m);
  parts_[kicks].per_call.add(Op::multiply, nu);
  parts_[kicks].per_call.add(Op::negate, nu);
  parts_[kicks].per_call.add_products(stored);
  parts_[shifts].per_call.add(Op::multiply, nu);
  parts_[shifts].per_call.add_products(weighted);
  parts_[gradients].per_call = gradients_[0].operations();  // not those of g itself
  for (const auto& pair : gradients_[0].couplings())
    parts_[matrix].per_call.add_dots(1, static_cast<Index>(pair.terms.size()));
  parts_[factors].per_call = system_.factor_operations();
  parts_[solution].per_call = system_.solve_operations();
  parts_[solution].per_call.add(Op::reciprocal, nu);
  parts_[solution].per_call.add(Op::subtract, nu);
  parts_[tangential].per_call = problem_.mass.operations();
  for (Index a = 0; a < nu; ++a)
    parts_[tangential].per_call.add_dots(1, static_cast<Index>(gradients_[0].pattern(a).coordinates.size()));
  parts_[tangential].per_call.add_products(stored);
}

template <Scalar S>
SolverCounts Rattle<S>::counts() const {
  return sum_of(earlier_, {potential_.counts(), parts_}, problem_);
}

template <Scalar S>
void Rattle<S>::measure_time() {
  timed_ = true;
  potential_.measure_time();
}

template <Scalar S>
void Rattle<S>::remember(Archive& archive) {
  archive(lambda_, multiplier_);
  this->remember_counts(archive, earlier_);
  if (archive.reading()) started_ = false;
}

template <Scalar S>
void Rattle<S>::arrive(const Vector<S>& q) {
  if (started_ && q == arrived_) return;
  potential_.force(lanes(q), force_);
  const PartCall counted = call(gradients);
  before().update(lanes(q));
  started_ = true;
}

template <Scalar S>
bool Rattle<S>::solve(ConstraintGradient<S>& left, const ConstraintGradient<S>& right, Matrix<S>& x) {
  const auto place = [&](Index a) { return order_.position[static_cast<std::size_t>(a)]; };
  {
    const PartCall counted = call(matrix);
    system_.set_zero();
    for (const auto& pair : left.couplings()) left.coupling(pair, right, &system_.entry(place(pair.a), place(pair.b)));
  }
  {
    const PartCall counted = call(factors);
    if (!system_.factor()) return false;
  }
  const PartCall counted = call(solution);
  for (Index a = 0; a < x.size(); ++a) set(x_[place(a)], x.data()[a]);
  system_.solve(x_);
  for (Index a = 0; a < x.size(); ++a) set(x.data()[a], x_[place(a)]);
  return true;
}

template <Scalar S>
void Rattle<S>::kick_and_drift(const State<S>& state) {
  const PartCall counted = call(kicks);
  for (Index j = 0; j < p_.size(); ++j) {
    set_product(p_[j], half_, force_(0, j));
    set_sum(p_[j], p_[j], state.p[j]);
  }
  problem_.mass.velocity(lanes(std::as_const(p_)), lanes(v_));
  for (Index j = 0; j < q_.size(); ++j) {
    set_product(free_[j], h_, v_[j]);
    set_sum(free_[j], free_[j], state.q[j]);
  }
}

template <Scalar S>
long Rattle<S>::find_positions() {
  constexpr long max_iterations = 50;
  const Index m = problem_.m(), nu = problem_.nu();
  // Each multiplier moves q_1 by -h^2/2 M^-1 grad g(q_0) lambda.
  const S factor = -h_ * half_;
  long iterations = 0;
  S last = 0, increment = 0, size = 0;
  for (bool found = nu == 0;;) {
    {
      const PartCall counted = call(shifts);
      set_product(mu_, factor, lambda_);
      set(q_, free_);
      before().add_weighted_times(mu_, lanes(q_));
    }
    {
      const PartCall counted = call(gradients);
      after().update(lanes(std::as_const(q_)), g_);
    }
    if (found) return iterations;
    set(mu_, g_);
    if (!solve(after(), before(), mu_) || ++iterations > max_iterations)
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
}

template <Scalar S>
void Rattle<S>::kick_back() {
  for (Index j = 0; j < p_.size(); ++j) {
    set_product(v_[j], half_, force_(0, j));
    set_sum(p_[j], p_[j], v_[j]);
  }
  for (Index a = 0; a < mu_.size(); ++a) {
    set_product(mu_.data()[a], half_, lambda_.data()[a]);
    set_negative(mu_.data()[a], mu_.data()[a]);
  }
  before().add_times(mu_, lanes(p_));
}

template <Scalar S>
void Rattle<S>::project(long iterations) {
  {
    const PartCall counted = call(tangential);
    problem_.mass.velocity(lanes(std::as_const(p_)), lanes(v_));
    for (Index a = 0; a < mu_.size(); ++a) after().transposed_times(a, lanes(std::as_const(v_)), &mu_(0, a));
  }
  if (!solve(after(), after(), mu_))
    throw StageFailure(FailureCause::near_singular_constraints, "the constraints' gradients are linearly dependent",
                       "0", iterations);
  for (Index a = 0; a < mu_.size(); ++a) {
    set_quotient(multiplier_[a], mu_.data()[a], half_);
    set_negative(mu_.data()[a], mu_.data()[a]);
  }
  after().add_times(mu_, lanes(p_));
}

template <Scalar S>
long Rattle<S>::step(State<S>& state, const S& h) {
  if (h != h_) {
    set(h_, h);
    set_product(half_, h, one_half_);
  }
  arrive(state.q);
  kick_and_drift(state);
  long iterations = 0;
  try {
    iterations = find_positions();
    // From here on force_ is that at q_1.
    started_ = false;
    potential_.force(lanes(std::as_const(q_)), force_);
    kick_back();
    if (problem_.nu() > 0) project(iterations);
    for (Index j = 0; j < q_.size(); ++j)
      if (!is_finite(q_[j]) || !is_finite(p_[j]))
        throw StageFailure(FailureCause::stage_equations_diverge, "a RATTLE step is not finite", "inf", iterations);
  } catch (const StageFailure&) {
    lambda_.setZero();
    throw;
  }
  set(arrived_, q_);
  state.q.swap(q_);
  state.p.swap(p_);
  now_ = 1 - now_;
  started_ = true;
  return iterations;
}

#define HBVM_DEFINE(S) template class Rattle<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm
