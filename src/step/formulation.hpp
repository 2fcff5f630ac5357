#pragma once

#include <string>
#include <string_view>

#include "hbvm/number.hpp"

namespace hbvm::core {

/// What becomes of constraints when a Runge-Kutta method integrates.
enum class OnConstraints {
  drift,      ///< the index-reduced equations as they stand: g and the hidden constraints drift away
  project,    ///< the same, and each step ends on both constraints
  baumgarte,  ///< lambda is such that g'' + 2 alpha g' + beta^2 g = 0
  ggl         ///< every stage and the end of a step fulfil both constraints
};

/// The form of the equations that a Runge-Kutta method is used on. See RungeKuttaStepper.
struct Formulation {
  OnConstraints on_constraints = OnConstraints::drift;
  Number alpha = "0", beta = "0";  ///< of Baumgarte, 1/time

  Formulation() = default;
  Formulation(OnConstraints kind) : on_constraints(kind) {}
  Formulation(OnConstraints kind, Number a, Number b) : on_constraints(kind), alpha(std::move(a)), beta(std::move(b)) {}

  /// What stands behind a method's name: "", "+project", "+baumgarte:5,5", "+ggl".
  std::string suffix() const;
  /// In titles: "", ", projected".
  std::string title() const;
  /// Whether steps end on g, and in its tangent space.
  bool ends_on_constraints() const {
    return on_constraints == OnConstraints::project || on_constraints == OnConstraints::ggl;
  }
};

/// The forms that can be asked for, in words.
constexpr std::string_view formulations = "+project, +baumgarte:ALPHA,BETA or +ggl";

/// A name that may end in a formulation, taken apart: "rk4+ggl" is rk4 and +ggl.
struct FormulatedName {
  std::string name;
  Formulation formulation;

  /// A suffix that is none stays in the name. \throws InputError for numbers of Baumgarte that are none
  static FormulatedName parse(std::string_view text);
};

}  // namespace hbvm::core
