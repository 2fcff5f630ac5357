#pragma once

#include "scene/scene.hpp"

namespace hbvm::core {

/// What a name in a formula of a scene stands for: a property of one of its places, or of two of them.
struct FormulaName {
  enum class Is { coordinate, difference, distance, mass, charge };
  Is is;
  std::size_t place = 0;  ///< among the ends of a pair, or of a group
  std::size_t axis = 0;
};
using FormulaNames = std::map<std::string, FormulaName, std::less<>>;

/// The names that a formula may use besides the constants.
FormulaNames formula_names(const SceneFormula& formula, int dimension);

/// The names of formula_names() that the formula does use.
/// \throws ExpressionError at a name that is neither one of them nor a constant, or that is both
FormulaNames names_used(const SceneFormula& formula, int dimension, const Constants& constants);

}  // namespace hbvm::core
