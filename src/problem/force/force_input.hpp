#pragma once

#include "problem/driven_point.hpp"
#include "problem/force/registry.hpp"
#include "problem/force_term.hpp"
#include "problem/formula/input.hpp"

namespace hbvm::core {

/// One use of a force by a scene: the formulas of its keys, with what their names stand for, and all it acts on. The
/// constants must outlive it.
template <Scalar S>
struct ForceInput {
  std::string kind, name;
  bool mutual = false;  ///< between two rigid bodies
  Index dimension = 0;
  Index arguments = 1, acting = 1;  ///< as ForceTerm has them
  const Constants& constants;
  std::map<std::string, std::vector<Expression>, std::less<>> values = {};  ///< of the keys, component by component
  /// Their names besides the constants: input i is component i of x_1 .. x_n, v_1 .. v_n.
  FormulaVariables variables = {};
  std::size_t parameters = 0;
  using Instance = typename FormulaInput<S>::Instance;
  std::vector<Instance> instances = {};
};

/// Evaluates the force's formula once on Traced values and compiles F and its derivatives. \throws InputError with the
/// key whose formula cannot be evaluated
template <Scalar S>
ForceTerm<S> make_force(const ForceInput<S>& input);

/// The potential that belongs to a force, as that of a turning frame; none if it has none. Of x alone.
template <Scalar S>
std::optional<EffectTerm<S>> potential_beside(const ForceInput<S>& input);

/// A point that moves along formulas of t, with their first and second derivatives.
/// \throws ExpressionError as record() does
template <Scalar S>
DrivenPoint<S> driven_point(std::string name, const std::vector<Expression>& position, const Constants& constants);

}  // namespace hbvm::core
