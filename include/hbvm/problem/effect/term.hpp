#pragma once

#include <string>
#include <vector>

#include "hbvm/problem/effect/program.hpp"
#include "hbvm/problem/effect/symmetry.hpp"
#include "hbvm/problem/space/displacement.hpp"

namespace hbvm {

/// One effect as a scene uses it: a formula for the displacement of a body or pair, and all the bodies or pairs it
/// holds for. Made by trace_effect from the effect's one definition.
template <Scalar S>
struct EffectTerm {
  std::string kind;
  int degree = 0;                              ///< of U as a polynomial in q; Trace::not_polynomial if it is none
  Program<S> value;                            ///< one output, U, from the d displacements and the coefficients
  Program<S> gradient;                         ///< d outputs, dU/dx
  Program<S> hessian;                          ///< d (d + 1)/2 outputs, the lower triangle of d2U/dx2 row by row
  bool constant_force = false;                 ///< dU/dx does not depend on x
  std::vector<Displacement<S>> displacements;  ///< one an instance
  Matrix<S> value_coefficients;                ///< instances x coefficients of `value`
  Matrix<S> gradient_coefficients;
  Matrix<S> hessian_coefficients;
  EffectSymmetry<S> symmetry;
};

}  // namespace hbvm
