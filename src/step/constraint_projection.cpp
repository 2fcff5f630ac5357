#include "step/constraint_projection.hpp"

#include "linear/arrays.hpp"
#include "scalar/in_place.hpp"
#include "scalar/text.hpp"

namespace hbvm::core {

template <Scalar S>
ConstraintProjection<S>::ConstraintProjection(const Problem<S>& problem)
    : problem_(problem),
      gradients_{{problem, 1}, {problem, 1}},
      shift_(Matrix<S>::Zero(1, problem.nu())),
      g_(shift_),
      mu_(shift_),
      v_(problem.m()),
      course_(problem, 1),
      x_(problem.nu()) {
  std::vector<std::pair<Index, Index>> entries;
  for (const auto& pair : gradients_[0].couplings()) entries.emplace_back(pair.a, pair.b);
  order_ = order_for_band(problem.nu(), entries);
  system_.resize(problem.nu(), order_.half_bandwidth);
  describe_parts();
}

template <Scalar S>
void ConstraintProjection<S>::describe_parts() {
  const ConstraintGradient<S>& gradient = gradients_[0];
  const Index nu = problem_.nu();
  parts_ = {{"positions"}, {"constraint gradients"}, {"matrix of multipliers"}, {"factors of it"},
            {"solution"},  {"tangential momenta"}};
  parts_[shifts].per_call.add(Op::multiply, nu);
  parts_[shifts].per_call.add_products(gradient.weighted_values().cols());
  parts_[gradients].per_call = gradient.operations() + gradient.weighing_operations();  // not those of g itself
  for (const auto& pair : gradient.couplings()) parts_[matrix].per_call.add_dots(1, pair.products);
  parts_[factors].per_call = system_.factor_operations();
  parts_[solution].per_call = system_.solve_operations();
  parts_[solution].per_call.add(Op::reciprocal, nu);
  parts_[solution].per_call.add(Op::subtract, nu);
  parts_[tangential].per_call = problem_.mass.operations();
  for (Index a = 0; a < nu; ++a) parts_[tangential].per_call += gradient.transposed_operations(a);
  parts_[tangential].per_call += gradient.times_operations();
}

template <Scalar S>
void ConstraintProjection<S>::set_directions(const Vector<S>& q0) {
  const PartCall counted(parts_[gradients]);
  directions().update(lanes(q0));
}

template <Scalar S>
void ConstraintProjection<S>::set_position(const Vector<S>& q) {
  const PartCall counted(parts_[gradients]);
  found().update(lanes(q));
  place(course_, problem_, q);
}

template <Scalar S>
bool ConstraintProjection<S>::solve(ConstraintGradient<S>& left, const ConstraintGradient<S>& right, Matrix<S>& x) {
  const auto row_of = [&](Index a) { return order_.position[static_cast<std::size_t>(a)]; };
  {
    const PartCall counted(parts_[matrix]);
    system_.set_zero();
    left.for_each_coupling(right, &product_,
                           [&](const auto& pair) { set(system_.entry(row_of(pair.a), row_of(pair.b)), product_); });
  }
  {
    const PartCall counted(parts_[factors]);
    if (!system_.factor()) return false;
  }
  const PartCall counted(parts_[solution]);
  for (Index a = 0; a < x.size(); ++a) set(x_[row_of(a)], x.data()[a]);
  system_.solve(x_);
  for (Index a = 0; a < x.size(); ++a) set(x.data()[a], x_[row_of(a)]);
  return true;
}

template <Scalar S>
bool ConstraintProjection<S>::is_round_off(const Vector<S>& q) {
  // The terms of g are off by 7/2 epsilon: a displacement, its square (its error twice, and one), two sums and the
  // difference from l^2. The stored q adds epsilon/2 of |grad g| |q|. The sum of 4 is doubled for a quadric's more
  // terms.
  constexpr int roundings = 8;
  for (Index a = 0; a < problem_.nu(); ++a) {
    S size = value(problem_.constraints[static_cast<std::size_t>(a)], problem_.dimension, q).size;
    const auto& pattern = found().pattern(a);
    for (std::size_t c = 0; c < pattern.coordinates.size(); ++c)
      size += magnitude(S(found().values()(0, pattern.first + static_cast<Index>(c)) * q[pattern.coordinates[c]]));
    if (!(magnitude(g_.data()[a]) <= roundings * size * epsilon<S>())) return false;
  }
  return true;
}

template <Scalar S>
long ConstraintProjection<S>::find_position(const Vector<S>& free, const S& factor, Matrix<S>& lambda, Vector<S>& q) {
  constexpr long max_iterations = 50;
  const Index m = problem_.m(), nu = problem_.nu();
  long iterations = 0;
  S last = 0, increment = 0, size = 0;
  for (bool converged = nu == 0, stagnant = false;;) {
    {
      const PartCall counted(parts_[shifts]);
      set_product(shift_, factor, lambda);
      set(q, free);
      directions().add_weighted_times(shift_, lanes(q));
    }
    {
      const PartCall counted(parts_[gradients]);
      found().update(lanes(std::as_const(q)), g_);
    }
    if (converged || (stagnant && is_round_off(q))) {
      place(course_, problem_, q);
      return iterations;
    }
    if (!solve(found(), directions(), g_) || ++iterations > max_iterations)
      throw StageFailure(FailureCause::stage_equations_diverge, "no position on the constraints was found",
                         to_scientific(increment, 3), iterations);
    using std::swap;
    swap(last, increment);
    set_zero(increment);
    set_zero(size);
    for (Index a = 0; a < nu; ++a) {
      S& change = g_.data()[a];
      set_quotient(change, change, factor);
      set_difference(lambda.data()[a], lambda.data()[a], change);
      raise_to(increment, magnitude(change));
      raise_to(size, magnitude(lambda.data()[a]));
    }
    // Convergence is quadratic: the next increment is this one times the square of the factor it fell by.
    const bool falls = iterations > 1 && 2 * increment < last;
    const S ratio = falls ? S(increment / last) : S(1);
    stagnant = iterations > 1 && !falls;
    converged = increment * ratio * ratio <= size * epsilon<S>() / 8 ||
                (stagnant && increment <= size * S(16 * (m + nu)) * epsilon<S>());
  }
}

template <Scalar S>
const Matrix<S>& ConstraintProjection<S>::make_tangential(Vector<S>& p, ConstraintGradient<S>& along) {
  {
    const PartCall counted(parts_[tangential]);
    problem_.mass.velocity(lanes(std::as_const(p)), lanes(v_));
    course_.set_velocities(lanes(v_));
    for (Index a = 0; a < mu_.size(); ++a) found().transposed_times(a, lanes(std::as_const(v_)), &mu_(0, a));
  }
  if (!solve(found(), along, mu_))
    throw StageFailure(FailureCause::near_singular_constraints, "the constraints' gradients are linearly dependent",
                       "0", 0);
  for (Index a = 0; a < mu_.size(); ++a) set_negative(shift_.data()[a], mu_.data()[a]);
  for (Index j = problem_.clock(); j < p.size(); ++j) set(v_[j], p[j]);
  along.add_times(shift_, lanes(p));
  for (Index j = problem_.clock(); j < p.size(); ++j) set(p[j], v_[j]);
  return mu_;
}

#define HBVM_DEFINE(S) template class ConstraintProjection<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
