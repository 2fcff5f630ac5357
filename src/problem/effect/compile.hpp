#pragma once

#include "problem/effect/term.hpp"
#include "problem/effect/trace.hpp"

namespace hbvm::core {

/// Fills in the programs of a term, for U and its first and second derivatives by the inputs, with their coefficients.
/// Also fills in what follows from the trace: degree and constant_force. `values` has the parameters of each instance.
/// \throws InputError if that takes more operations than anyone writes by hand
template <Scalar S>
void compile(Trace<S>& trace, typename Trace<S>::Id U, std::size_t inputs, std::size_t parameters,
             const std::vector<std::vector<S>>& values, EffectTerm<S>& term);

}  // namespace hbvm::core
