#pragma once

#include "problem/formula/input.hpp"
#include "problem/problem.hpp"

namespace hbvm::core {

/// The symmetry of a formula: equations for the motions of space (w, t), as EffectSymmetry::conditions has them, that
/// keep all instances. A motion moves the displacements by w x x_a + T_a t. There x_a is without its shift, and T_a is
/// the sum of the weights of what translates. It changes U by
///
///     w . sum_a x_a x dU/dx_a + t . sum_a T_a dU/dx_a,
///
/// which is evaluated at some points near q in so many digits that a part of U of 10^-300 beside another counts. A part
/// that is far less there, such as a narrow bump far away, counts as well. It is evaluated once more with exponents
/// near 0.
/// \param blocks of the problem
template <Scalar S>
EffectSymmetry<S> formula_symmetry(const FormulaInput<S>& input, const std::vector<SpaceBlock>& blocks,
                                   const Vector<S>& q);

}  // namespace hbvm::core
