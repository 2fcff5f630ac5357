#pragma once

#include <string>
#include <variant>
#include <vector>

#include "hbvm/problem/lanes.hpp"

namespace hbvm {

/// g = x.y - value for two displacements: the distance of two bodies (x = y) or an angle between two rods.
template <Scalar S>
struct DisplacementProduct {
  Displacement<S> x, y;
  bool same = false;  ///< y is x
  S value;
};

/// g = q^T A q + b^T q + c for the block q of one body, A symmetric.
template <Scalar S>
struct Quadric {
  Index offset = 0;
  Matrix<S> A;
  Vector<S> b;
  S c;
};

/// g = n.q - offset for the block of one body.
template <Scalar S>
struct Plane {
  Index block = 0;
  Vector<S> normal;
  S offset;
};

/// One component of g(q) = 0 of (gq), at most quadratic.
template <Scalar S>
struct Constraint {
  std::string name;  ///< for messages: "rod a-b"
  std::variant<DisplacementProduct<S>, Quadric<S>, Plane<S>> form;
};

/// The coordinates a constraint depends on, ascending.
template <Scalar S>
std::vector<Index> coordinates(const Constraint<S>& constraint, Index dimension);

/// g(q), and the sum of the magnitudes of its terms, which its round-off is proportional to.
template <Scalar S>
struct ConstraintValue {
  S g, size;
};
template <Scalar S>
ConstraintValue<S> value(const Constraint<S>& constraint, Index dimension, const Vector<S>& q);

/// The constant second derivative applied to v twice: (nabla^2 g)(v, v).
template <Scalar S>
S curvature(const Constraint<S>& constraint, Index dimension, const Vector<S>& v);
/// The sum of the magnitudes of its terms in the coordinates of v.
template <Scalar S>
S curvature_size(const Constraint<S>& constraint, Index dimension, const Vector<S>& v);

#define HBVM_DECLARE(S)                                                                       \
  extern template std::vector<Index> coordinates<S>(const Constraint<S>&, Index);             \
  extern template ConstraintValue<S> value<S>(const Constraint<S>&, Index, const Vector<S>&); \
  extern template S curvature<S>(const Constraint<S>&, Index, const Vector<S>&);              \
  extern template S curvature_size<S>(const Constraint<S>&, Index, const Vector<S>&);
HBVM_FOR_EACH_SCALAR(HBVM_DECLARE)
#undef HBVM_DECLARE

}  // namespace hbvm
