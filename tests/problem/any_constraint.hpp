#pragma once

#include "problem/constraint.hpp"
#include "problem/dense.hpp"
#include "scalar/random_values.hpp"

namespace hbvm::core {

/// A constraint of this form as a scene would make it, the first if it makes several, with random numbers. Its pairs
/// are bodies 0 and 1, 1 and 2, ..., its bodies the bodies 1, 2, ... of d coordinates each.
template <class Form, Scalar S>
Constraint<S> any_constraint(Index d, RandomValues<S>& random) {
  ConstraintInput<S> input;
  input.dimension = d;
  Index pairs = 0, bodies = 0;
  for (const ConstraintKey& key : Form::keys) {
    using Takes = ConstraintKey::Takes;
    switch (key.takes) {
      case Takes::pair: {
        const Index a = pairs++;
        input.pairs.emplace(key.name, Displacement<S>{{{a * d, S(1)}, {(a + 1) * d, S(-1)}}, random.vector(d)});
        break;
      }
      case Takes::body:
        input.bodies.emplace(key.name, Displacement<S>{{{++bodies * d, S(1)}}, {}});
        break;
      case Takes::number:
        input.numbers.emplace(key.name, S(2 + random.value()));
        break;
      case Takes::vector:
        input.vectors.emplace(key.name, random.vector(d));
        break;
      case Takes::symmetric_matrix:
        input.matrices.emplace(key.name, mass_block<S>(d));
        break;
    }
  }
  Constraint<S> constraint{std::string(Form::kind), {}};
  if constexpr (requires { Form::from(input).front().second; })
    std::visit([&](const auto& form) { constraint.form = form; }, Form::from(input).front().second);
  else if constexpr (requires { Form::from(input).index(); })
    std::visit([&](const auto& form) { constraint.form = form; }, Form::from(input));
  else
    constraint.form = Form::from(input);
  return constraint;
}

/// Three bodies, of which the last two share a block of the mass matrix, under this constraint alone.
template <Scalar S>
Problem<S> three_bodies(Index d, Constraint<S> constraint) {
  Problem<S> problem;
  problem.dimension = problem.potential.dimension = d;
  problem.mass.add_scalar(d, S(2));
  problem.mass.add_full(mass_block<S>(2 * d));
  problem.potential.m = problem.m();
  problem.constraints = {std::move(constraint)};
  return problem;
}

}  // namespace hbvm::core
