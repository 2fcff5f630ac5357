#include "step/tableau_method.hpp"

#include <algorithm>

#include "method/decimals.hpp"
#include "method/known_tableaux.hpp"
#include "method/order_conditions.hpp"
#include "method/read_tableau.hpp"
#include "method/symmetry_defect.hpp"

namespace hbvm::core {
namespace {

constexpr unsigned digits_of_conditions = 50;

/// What the sums of its conditions may lose, and decimals of fewer digits with them.
Mpfr tolerance(const Tableau& tableau) {
  constexpr int lost = 10, lost_of_decimals = 4;
  int digits = static_cast<int>(digits_of_conditions) - lost;
  if (const std::optional<Decimals> decimals = decimals_of(tableau))
    digits = std::clamp(decimals->digits - lost_of_decimals, 1, digits);
  return pow(Mpfr(10), -digits);
}

}  // namespace

TableauMethod::TableauMethod(Tableau tableau, std::string name, Formulation formulation)
    : tableau_(std::move(tableau)), name_(std::move(name)), formulation_(std::move(formulation)) {}

int TableauMethod::order() const {
  const PrecisionScope scope(digits_of_conditions);
  const int order =
      tableau_.order ? *tableau_.order : hbvm::core::order(make_runge_kutta<Mpfr>(tableau_), tolerance(tableau_));
  constexpr int of_ggl = 2;
  return formulation_.on_constraints == OnConstraints::ggl ? std::min(order, of_ggl) : order;
}

Kept TableauMethod::kept() const {
  if (formulation_.ends_on_constraints())
    return {.energy = false, .momenta = false, .constraints = true, .hidden = true, .reversal = false};
  const PrecisionScope scope(digits_of_conditions);
  const RungeKutta<Mpfr> method = make_runge_kutta<Mpfr>(tableau_);
  return {.energy = false,
          .momenta = symplecticity_defect(method) <= tolerance(tableau_),
          .constraints = false,
          .hidden = false,
          .reversal = symmetry_defect(method) <= tolerance(tableau_)};
}

std::string TableauMethod::text() const { return name_ + formulation_.suffix(); }

std::string TableauMethod::title() const { return tableau_.name + formulation_.title(); }

std::string TableauMethod::key() const {
  std::string key = title();
  for (const auto& row : tableau_.A)
    for (const Number& x : row) key += "," + x.text();
  for (const Number& x : tableau_.b) key += "," + x.text();
  for (const Number& x : tableau_.c) key += "," + x.text();
  if (tableau_.digits) key += ",digits " + std::to_string(*tableau_.digits);
  return key;
}

Constants TableauMethod::parameters() const { return letter_s(stages()); }

template <Scalar S>
StepperMaker<S> TableauMethod::prepare_in(const Problem<S>& problem, SolverKind) const {
  if (formulation_.on_constraints == OnConstraints::ggl && problem.nu() > 0) require_conservative(problem, text());
  return [&problem, method = make_runge_kutta<S>(tableau_), formulation = formulation_] {
    return std::make_unique<RungeKuttaStepper<S>>(problem, method, formulation);
  };
}

MethodPtr tableau_method(std::string_view arguments) {
  auto [file, formulation] = FormulatedName::parse(arguments);
  if (file.empty()) throw InputError("method tableau: use tableau:FILE, which may end in " + std::string(formulations));
  return std::make_shared<const TableauMethod>(read_tableau(file), "tableau:" + file, std::move(formulation));
}

MethodPtr known_tableau_method(std::string_view text) {
  const auto [name, formulation] = FormulatedName::parse(text);
  std::string all;
  for (const KnownTableau& known : known_tableaux()) {
    if (known.name == name) return std::make_shared<const TableauMethod>(known.tableau, name, formulation);
    all += (all.empty() ? "" : ", ") + std::string(known.name);
  }
  throw InputError("unknown method '" + std::string(text) + "': there are " + all);
}

const TableauMethod* as_tableau(const Method& method) { return dynamic_cast<const TableauMethod*>(&method); }

#define HBVM_DEFINE(S) template StepperMaker<S> TableauMethod::prepare_in<S>(const Problem<S>&, SolverKind) const;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
