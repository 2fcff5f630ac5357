#pragma once

#include <algorithm>
#include <set>
#include <vector>

#include "problem/constraint.hpp"
#include "problem/driven_point.hpp"
#include "problem/effect/trace.hpp"
#include "problem/force_term.hpp"
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
///
/// Where forces F act that have no potential, or t stands in U, F or g, or points move, it is
///
///     p' = grad U(q, t) + F(q, v, t) - grad g(q, t) lambda,   g(q, t) = 0,   v = M^-1 p.
///
/// Then there are driven points. Their coordinates X(t) are the last of q, the first of them t itself. So t is one of
/// the coordinates on which U, F and g depend. The momentum of a driven coordinate is minus the work done by way of it,
///
///     p_X' = X' (dU/dX + F_X - (grad g lambda)_X),
///
/// less F.v of each F whose account it is. By that H + sum p_X = H - W is constant along a motion as H is where no
/// point is driven.
template <Scalar S>
struct Problem {
  Index dimension = 0;  ///< of space: 2 or 3
  MassMatrix<S> mass;
  std::vector<Constraint<S>> constraints;
  Potential<S> potential;
  std::vector<SpaceBlock> blocks;
  std::vector<RedundantConstraint<S>> redundant = {};  ///< not among `constraints`, which are independent; ascending
  std::vector<ForceTerm<S>> forces = {};               ///< that have no potential
  std::vector<DrivenPoint<S>> driven = {};             ///< the first is t itself

  Index m() const { return mass.m(); }
  Index nu() const { return static_cast<Index>(constraints.size()); }
  /// Whether there are neither forces without a potential nor driven points.
  bool is_conservative() const { return forces.empty() && driven.empty(); }
  /// The coordinate that is t. There is one where points are driven.
  Index clock() const { return mass.of_bodies(); }
  /// Appends a driven point. \return its first coordinate
  Index add(DrivenPoint<S> point) {
    const Index offset = m();
    mass.add_driven(dimension);
    driven.push_back(std::move(point));
    return offset;
  }
};

/// Whether a constraint or term moves with a point whose course is no polynomial of degree 1.
template <Scalar S>
bool follows_course(const Problem<S>& problem, const std::set<Index>& coordinates) {
  return std::ranges::any_of(coordinates, [&](Index j) {
    if (j < problem.clock()) return false;
    const auto point = static_cast<std::size_t>((j - problem.clock()) / problem.dimension);
    return !problem.driven[point].course.instructions().empty();
  });
}

/// The greatest degree of a constraint as a polynomial in q and t, at least 2, or Trace::not_polynomial.
template <Scalar S>
int degree_of_g(const Problem<S>& problem) {
  for (const Constraint<S>& constraint : problem.constraints) {
    const std::vector<Index> own = coordinates(constraint, problem.dimension);
    if (follows_course(problem, {own.begin(), own.end()})) return Trace<S>::not_polynomial;
  }
  return degree(problem.constraints);
}

/// The kind of an effect as they are counted: those of the potential, then the forces without one.
template <Scalar S>
const std::string& kind_of_effect(const Problem<S>& problem, std::size_t number) {
  const std::size_t potentials = problem.potential.terms.size();
  return number < potentials ? problem.potential.terms[number].kind : problem.forces[number - potentials].kind;
}

}  // namespace hbvm::core
