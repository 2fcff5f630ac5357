#pragma once

#include <algorithm>
#include <set>

#include "problem/formula/input.hpp"
#include "scene/formula_names.hpp"

namespace hbvm::core {

/// What the names of a formula in a scene stand for in one precision. Formula and constants must outlive it.
template <Scalar S>
class FormulaBinding {
 public:
  FormulaBinding(const SceneFormula& formula, Index dimension, const Constants& constants)
      : formula_(formula),
        dimension_(dimension),
        constants_(constants),
        names_(names_used(formula, static_cast<int>(dimension), constants)) {
    std::set<std::size_t> used;
    for (const auto& [name, is] : names_)
      if (is.is == FormulaName::Is::coordinate)
        used.insert(is.place);
      else if (is.is == FormulaName::Is::time)
        timed_ = true;
    if (formula.acts == Acts::on_group) {
      if (used.empty()) used = {0};
    } else if (formula.acts == Acts::between_pairs) {
      // Unless a position is named, it depends on the displacement alone.
      if (!used.empty()) used = {0, 1};
    } else {
      used = {0};
    }
    places_.assign(used.begin(), used.end());
  }

  /// Without instances.
  FormulaInput<S> input() const {
    FormulaInput<S> result{formula_.expression, constants_, dimension_};
    result.arguments = positions() + (timed_ ? 1 : 0);
    result.timed = timed_;
    for (const auto& [name, is] : names_) result.variables[name] = variable(is, result.parameters);
    return result;
  }

  /// For these bodies and points, one for each that the formula is about.
  /// \param scene gives position, difference, mass and charge by names, and the time
  typename FormulaInput<S>::Instance instance(const std::vector<std::string>& of, auto&& scene) const {
    typename FormulaInput<S>::Instance result;
    if (places_.empty()) result.x.push_back(scene.difference(of[0], of[1]));
    for (const std::size_t place : places_) result.x.push_back(scene.position(of[place]));
    if (timed_) result.x.push_back(scene.time());
    for (const auto& [name, is] : names_) {
      if (is.is == FormulaName::Is::mass) result.parameters.push_back(scene.mass(of[is.place]));
      if (is.is == FormulaName::Is::charge) result.parameters.push_back(scene.charge(of[is.place]));
    }
    return result;
  }

 private:
  /// Displacements of an instance, but for the time.
  Index positions() const { return places_.empty() ? 1 : static_cast<Index>(places_.size()); }
  /// \param parameters so many are known; one more if the name is one
  FormulaVariable variable(const FormulaName& is, std::size_t& parameters) const {
    using Is = FormulaVariable::Is;
    switch (is.is) {
      case FormulaName::Is::coordinate: {
        const auto argument = std::lower_bound(places_.begin(), places_.end(), is.place) - places_.begin();
        return {Is::input, static_cast<std::size_t>(argument * dimension_) + is.axis};
      }
      case FormulaName::Is::difference:
        return {Is::difference, is.axis};
      case FormulaName::Is::distance:
        return {Is::distance, 0};
      case FormulaName::Is::time:
        return {Is::input, static_cast<std::size_t>(positions() * dimension_)};
      default:
        return {Is::parameter, parameters++};
    }
  }

  const SceneFormula& formula_;
  Index dimension_;
  const Constants& constants_;
  FormulaNames names_;
  bool timed_ = false;
  std::vector<std::size_t> places_;  ///< whose positions are inputs, ascending; none for the displacement of a pair
};

}  // namespace hbvm::core
