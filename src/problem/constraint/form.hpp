#pragma once

#include <concepts>
#include <set>
#include <vector>

#include "problem/constraint/gradient_target.hpp"
#include "problem/constraint/input.hpp"
#include "problem/constraint/value.hpp"

namespace hbvm::core {

/// What a form of g says of itself, all of it: a constraint at most quadratic in q.
///
///     kind, keys          as a scene names it, and its keys besides
///     from(input)         made of the values of the keys, of one form or as ConstraintParts; \throws InputError
///     coordinates(d)      those that g depends on
///     value(d, q)         g with the size of its terms
///     gradient_size(d, r) an upper bound of the sum of the magnitudes in grad g where max |q_i| = r
///     curvature(d, v)     (nabla^2 g)(v, v)
///     second_derivatives(d, add)  add(i, j, d2g/dq_i dq_j) of all that are not 0, parts of a sum one by one
///     positive()          with the magnitudes of the coefficients of its quadratic part
///     in_double()         the same form, rounded
///     stays(conditions)   which motions of space keep it: see symmetry_conditions
///     Gradient            evaluates grad g, and g, in lanes: begin writes what is constant, update what is not; it may
///                         have is_opposite(), if the second half of the columns can be the negatives of the first
template <class F, class S>
concept ConstraintForm = requires(const F& form, Index d, const Vector<S>& q, const S& r,
                                  const ConstraintInput<S>& input, void (*add)(Index, Index, const S&),
                                  Lanes<const S> lanes, const GradientTarget<S>& target,
                                  typename F::Gradient& gradient) {
  { F::kind } -> std::convertible_to<std::string_view>;
  { *F::keys.begin() } -> std::convertible_to<ConstraintKey>;
  F::from(input);
  { form.coordinates(d) } -> std::same_as<std::set<Index>>;
  { form.value(d, q) } -> std::same_as<ConstraintValue<S>>;
  { form.gradient_size(d, r) } -> std::same_as<S>;
  { form.curvature(d, q) } -> std::same_as<S>;
  form.second_derivatives(d, add);
  { form.positive() } -> std::same_as<F>;
  form.in_double();
  requires std::constructible_from < typename F::Gradient, const F&, Index, const std::vector<Index>
  & > ;
  gradient.begin(target);
  gradient.update(lanes, target);
  { gradient.operations() } -> std::same_as<OperationCounts>;
};

}  // namespace hbvm::core
