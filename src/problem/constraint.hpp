#pragma once

#include <map>
#include <string>
#include <vector>

#include "problem/constraint/registry.hpp"

namespace hbvm::core {

/// One component of g(q) = 0 of (2).
template <Scalar S>
struct Constraint {
  std::string name;  ///< for messages: "rod 'a'-'b'"
  ConstraintForms<S> form;
};

/// The coordinates a constraint depends on, ascending.
template <Scalar S>
std::vector<Index> coordinates(const Constraint<S>& constraint, Index dimension);

/// g(q) with the size of its terms.
template <Scalar S>
ConstraintValue<S> value(const Constraint<S>& constraint, Index dimension, const Vector<S>& q);

/// An upper bound of the sum of the magnitudes of the terms of grad g at q.
template <Scalar S>
S gradient_size(const Constraint<S>& constraint, Index dimension, const Vector<S>& q);

/// Degree of g as a polynomial in q, 2 for all that are no formulas; Trace::not_polynomial if it is none.
template <Scalar S>
int degree(const Constraint<S>& constraint);
/// The greatest of them, at least 2, or Trace::not_polynomial.
template <Scalar S>
int degree(const std::vector<Constraint<S>>& constraints);

/// The second derivative at q, constant if g is quadratic, applied to v twice: (nabla^2 g)(v, v).
template <Scalar S>
S curvature(const Constraint<S>& constraint, Index dimension, const Vector<S>& q, const Vector<S>& v);
/// The sum of the magnitudes of its terms in the coordinates of v.
template <Scalar S>
S curvature_size(const Constraint<S>& constraint, Index dimension, const Vector<S>& q, const Vector<S>& v);

/// The second derivatives of a quadratic g that are not 0, row by row; none of a formula, whose depend on q.
template <Scalar S>
std::map<Index, std::map<Index, S>> second_derivatives(const Constraint<S>& constraint, Index dimension);

/// The constraint with all numbers rounded to double.
template <Scalar S>
Constraint<double> in_double(const Constraint<S>& constraint);

}  // namespace hbvm::core
