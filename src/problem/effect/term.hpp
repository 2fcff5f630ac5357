#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "problem/effect/program.hpp"
#include "problem/effect/symmetry.hpp"
#include "problem/space/displacement.hpp"

namespace hbvm::core {

/// One effect as a scene uses it. It has a formula for the displacement of a body or pair, or for several positions. It
/// has all the bodies, pairs or groups that the formula holds for. Made by make_term from the effect's one definition.
template <Scalar S>
struct EffectTerm {
  std::string kind;
  int degree = 0;                              ///< of U as a polynomial in q; Trace::not_polynomial if it is none
  Program<S> value;                            ///< one output, U, from the n inputs and the coefficients
  Program<S> gradient;                         ///< n outputs, dU/dx
  Program<S> hessian;                          ///< n (n + 1)/2 outputs, the lower triangle of d2U/dx2 row by row
  bool constant_force = false;                 ///< dU/dx does not depend on x
  Index arguments = 1;                         ///< displacements of an instance, of d inputs each: n = arguments d
  std::vector<Displacement<S>> displacements;  ///< instance after instance
  Matrix<S> value_coefficients;                ///< instances x coefficients of `value`
  Matrix<S> gradient_coefficients;
  Matrix<S> hessian_coefficients;
  EffectSymmetry<S> symmetry;

  Index instances() const { return static_cast<Index>(displacements.size()) / arguments; }
  const Displacement<S>& displacement(Index instance, Index argument) const {
    return displacements[static_cast<std::size_t>(instance * arguments + argument)];
  }
};

/// Whether both act on the same bodies, pairs or groups, in the same order.
template <Scalar S>
bool acts_alike(const EffectTerm<S>& x, const EffectTerm<S>& y) {
  return x.arguments == y.arguments && std::ranges::equal(x.displacements, y.displacements, is_same<S>);
}

/// All displacements of a term at q, as its programs read them. Component i of an instance in lane l goes to out[i *
/// stride + instance * lanes + l].
template <Scalar S>
void displace(const EffectTerm<S>& term, Index dimension, Lanes<const S> q, S* out, Index stride) {
  for (Index n = 0; n < term.instances(); ++n)
    for (Index a = 0; a < term.arguments; ++a)
      displace(term.displacement(n, a), dimension, q, out + a * dimension * stride + n * q.count, stride);
}

/// The same as rows of a matrix, one for each instance and lane.
template <Scalar S>
void displace(const EffectTerm<S>& term, Index dimension, Lanes<const S> q, Matrix<S>& out) {
  displace(term, dimension, q, out.data(), out.rows());
}

/// The displacements of one instance at q, one after the other.
template <Scalar S>
Vector<S> displaced(const EffectTerm<S>& term, Index instance, Index dimension, const Vector<S>& q) {
  Vector<S> x(term.arguments * dimension);
  for (Index a = 0; a < term.arguments; ++a)
    x.segment(a * dimension, dimension) = displaced(term.displacement(instance, a), dimension, q);
  return x;
}

/// The term with all numbers rounded to double.
template <Scalar S>
EffectTerm<double> in_double(const EffectTerm<S>& term);

}  // namespace hbvm::core
