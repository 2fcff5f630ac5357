#pragma once

#include "scene/scene.hpp"

namespace hbvm::core {

/// What a name in a formula of a scene stands for: a property of one of its places, or of two of them.
struct FormulaName {
  enum class Is { coordinate, difference, distance, mass, charge, velocity, time };
  Is is;
  std::size_t place = 0;  ///< among the ends of a pair, or of a group
  std::size_t axis = 0;
};
using FormulaNames = std::map<std::string, FormulaName, std::less<>>;

/// The names that a formula may use besides the constants.
FormulaNames formula_names(const SceneFormula& formula, int dimension);

/// The names that a formula of a force may use, of bodies by themselves or of a group. \param local whether it may name
/// more than t
FormulaNames force_names(const std::vector<std::string>& of, bool local, int dimension);

/// Those of the known names that an expression uses. t is the time, unless there is a constant of that name.
/// \throws ExpressionError at a name that is neither one of them nor a constant, or that is both
FormulaNames names_used(const Expression& expression, FormulaNames known, const Constants& constants);
/// The names of formula_names() that the formula does use.
/// \throws ExpressionError at a name that is neither one of them nor a constant, or that is both
FormulaNames names_used(const SceneFormula& formula, int dimension, const Constants& constants);

}  // namespace hbvm::core
