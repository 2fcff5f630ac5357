#pragma once

#include <vector>

#include "problem/constraint.hpp"
#include "problem/mass_matrix.hpp"
#include "problem/potential.hpp"

namespace hbvm::core {

/// Coordinates offset .. offset + dimension are a vector in space. It is the position of a body, which translates with
/// space, or a director of a rigid body, which only turns with it.
struct SpaceBlock {
  Index offset;
  bool translates;
};

/// A constraint that follows from others: its number among all of them, from 0.
template <Scalar S>
struct RedundantConstraint {
  Index place;
  Constraint<S> constraint;
};

/// The constrained Hamiltonian problem (5)
///
///     H(q, p) = 1/2 p^T M^-1 p - U(q),   g(q) = 0 in R^nu,
///     q' = M^-1 p,   p' = grad U(q) - grad g(q) lambda.
///
/// Mind the sign: U is minus the potential energy. Coordinates stand body after body.
template <Scalar S>
struct Problem {
  Index dimension = 0;  ///< of space: 2 or 3
  MassMatrix<S> mass;
  std::vector<Constraint<S>> constraints;
  Potential<S> potential;
  std::vector<SpaceBlock> blocks;
  std::vector<RedundantConstraint<S>> redundant = {};  ///< not among `constraints`, which are independent; ascending

  Index m() const { return mass.m(); }
  Index nu() const { return static_cast<Index>(constraints.size()); }
};

}  // namespace hbvm::core
