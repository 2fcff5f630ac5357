#include "step/hbvm_method.hpp"

#include <algorithm>

#include "problem/effect/trace.hpp"
#include "step/hbvm_stepper.hpp"

namespace hbvm::core {

HbvmMethod::HbvmMethod(HbvmName name, std::optional<Perturbation> perturbation)
    : name_(name), perturbation_(std::move(perturbation)) {
  name_.check();
  if (perturbation_) static_cast<void>(coefficients<double>());
}

template <Scalar S>
int HbvmMethod::constraint_nodes(const Problem<S>& problem) const {
  if (name_.r != 0) return name_.r;
  const int d = degree_of_g(problem);
  if (d == Trace<S>::not_polynomial) return std::max(name_.k, name_.s);
  return exact_nodes(d, name_.s);
}

template <Scalar S>
Hbvm<S> HbvmMethod::coefficients(int r) const {
  if (name_.is_auto()) throw InputError("method " + text() + ": K is not chosen yet");
  Hbvm<S> method = make_hbvm<S>(name_.k, name_.s, r);
  if (perturbation_) perturb(method, *perturbation_);
  return method;
}

std::string HbvmMethod::title() const {
  return "HBVM(" + (name_.is_auto() ? "auto" : std::to_string(name_.k)) + "," + std::to_string(name_.s) +
         (name_.r == 0 ? "" : "," + std::to_string(name_.r)) + ")";
}

std::string HbvmMethod::key() const {
  if (!perturbation_) return text();
  const Perturbation& p = *perturbation_;
  return text() + "|" + std::to_string(static_cast<int>(p.part)) + (p.hat ? "^" : "") + std::to_string(p.i) + "," +
         std::to_string(p.j) + "," + p.relative.text();
}

Kept HbvmMethod::kept() const {
  const bool gauss = name_.k == name_.s && (name_.r == 0 || name_.r == name_.s);
  return {.energy = true, .momenta = gauss, .constraints = true, .hidden = false, .reversal = true};
}

Orders HbvmMethod::orders() const {
  const int k = name_.k, s = name_.s;
  const int r = s % 2 == 0 ? s : s + 1;
  return {.p = r, .lambda = r - 1, .hidden = r, .energy = 2 * k, .angular_momentum = kept().momenta ? 0 : 2 * s};
}

Constants HbvmMethod::parameters() const {
  Constants letters = letter_s(name_.s);
  if (!name_.is_auto()) letters.insert_or_assign("k", Expression::parse(std::to_string(name_.k)));
  if (name_.r != 0) letters.insert_or_assign("r", Expression::parse(std::to_string(name_.r)));
  return letters;
}

template <Scalar S>
StepperMaker<S> HbvmMethod::prepare_in(const Problem<S>& problem, SolverKind solver) const {
  return [&problem, solver, method = std::make_shared<const Hbvm<S>>(coefficients<S>(constraint_nodes(problem)))] {
    return std::make_unique<HbvmStepper<S>>(problem, method, solver);
  };
}

MethodPtr hbvm_of(HbvmName name, std::optional<Perturbation> perturbation) {
  return std::make_shared<const HbvmMethod>(name, std::move(perturbation));
}

MethodPtr hbvm_method(std::string_view arguments) {
  return std::make_shared<const HbvmMethod>(HbvmName::parse("hbvm:" + std::string(arguments)));
}

const HbvmMethod* as_hbvm(const Method& method) { return dynamic_cast<const HbvmMethod*>(&method); }

#define HBVM_DEFINE(S)                                                   \
  template int HbvmMethod::constraint_nodes<S>(const Problem<S>&) const; \
  template Hbvm<S> HbvmMethod::coefficients<S>(int) const;               \
  template StepperMaker<S> HbvmMethod::prepare_in<S>(const Problem<S>&, SolverKind) const;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
