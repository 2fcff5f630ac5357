#pragma once

#include <optional>

#include "problem/constraint/registry.hpp"
#include "problem/formula/input.hpp"

namespace hbvm::core {

/// The form that g is where its trace has a degree of 2 at most. Its coefficients are right to the last bit, whatever
/// cancels in the formula. |x|^2 - c for a sum x of positions with the weights 1 and -1 is a Rod. n.q - c of one body
/// is a Plane, and anything else a Quadric. No form if g is not quadratic. \param input of one instance
template <Scalar S>
std::optional<ConstraintForms<S>> quadratic_form(const FormulaInput<S>& input);

}  // namespace hbvm::core
