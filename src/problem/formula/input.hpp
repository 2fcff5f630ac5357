#pragma once

#include <map>
#include <string>
#include <vector>

#include "problem/effect/term.hpp"
#include "problem/effect/trace.hpp"
#include "scalar/expression.hpp"

namespace hbvm::core {

/// What a name in a formula stands for, where it is no constant.
struct FormulaVariable {
  enum class Is {
    input,       ///< component `index` of the displacements, one after the other
    difference,  ///< component `index` of the first less that of the second
    distance,    ///< the length of the first, or of its difference from the second if there are two
    parameter    ///< number `index` of those that each instance has, as a mass
  };
  Is is = Is::input;
  std::size_t index = 0;
};
using FormulaVariables = std::map<std::string, FormulaVariable, std::less<>>;

/// A formula of a scene, U or g, with what its names stand for and all it holds for. Formula and constants must outlive
/// it.
template <Scalar S>
struct FormulaInput {
  const Expression& formula;
  const Constants& constants;
  Index dimension = 0;
  Index arguments = 1;  ///< displacements of an instance
  FormulaVariables variables = {};
  std::size_t parameters = 0;
  struct Instance {
    std::vector<Displacement<S>> x;
    std::vector<S> parameters;
  };
  std::vector<Instance> instances = {};
  bool timed = false;  ///< the last of the arguments is (t, 0, 0)

  std::size_t inputs() const { return static_cast<std::size_t>(arguments * dimension); }
};

/// The formula evaluated once on Traced values: its inputs and parameters are those of the trace.
/// \throws ExpressionError at a place of the formula: a part without variables that has no value, an unknown name
template <Scalar S>
Traced<S> record(const FormulaInput<S>& input, Trace<S>& trace);

/// Evaluates the formula once on Traced values and compiles it and its derivatives. Its symmetry is left open.
/// \throws ExpressionError at a place of the formula: a part without variables that has no value, an unknown name
/// \throws InputError if its derivatives take too many operations
template <Scalar S>
EffectTerm<S> make_term(const FormulaInput<S>& input);

/// Refuses a formula that has no value, or none of its derivatives, where an instance is at q.
/// \throws ExpressionError at the operation that has none
template <Scalar S>
void check_formula(const FormulaInput<S>& input, const EffectTerm<S>& term, const Vector<S>& q);

/// The use of the formula in the digits of the scope, with nothing rounded.
template <Scalar S>
FormulaInput<Mpfr> exactly(const FormulaInput<S>& input);

}  // namespace hbvm::core
