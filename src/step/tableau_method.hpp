#pragma once

#include "method/runge_kutta.hpp"
#include "step/method.hpp"
#include "step/runge_kutta_stepper.hpp"

namespace hbvm::core {

/// A Runge-Kutta method from a file or by a name, see RungeKuttaStepper for what it makes of constraints.
class TableauMethod final : public MethodByTemplate<TableauMethod> {
 public:
  /// \param name as it is asked for, without its formulation
  TableauMethod(Tableau tableau, std::string name, Formulation formulation = {});

  const Tableau& tableau() const { return tableau_; }
  const Formulation& formulation() const { return formulation_; }

  std::string text() const override;
  std::string title() const override;
  std::string key() const override;
  /// That its author states, or its conditions show with 50 digits. Of GGL, which has conditions of its own, at most 2.
  int order() const override;
  int stages() const override { return static_cast<int>(tableau_.b.size()); }
  int terms() const override { return stages(); }
  /// As its coefficients show, on problems without constraints; of projected steps the constraints alone are known.
  Kept kept() const override;
  Constants parameters() const override;

  template <Scalar S>
  StepperMaker<S> prepare_in(const Problem<S>& problem, SolverKind solver) const;

 private:
  Tableau tableau_;
  std::string name_;
  Formulation formulation_;
};

/// From a file: "FILE", "FILE+project". \throws InputError as read_tableau does
MethodPtr tableau_method(std::string_view arguments);

/// One of known_tableaux(): "rk4", "sdirk:3+project". \throws InputError with what there is
MethodPtr known_tableau_method(std::string_view text);

/// The method as one of these, or null.
const TableauMethod* as_tableau(const Method& method);

}  // namespace hbvm::core
