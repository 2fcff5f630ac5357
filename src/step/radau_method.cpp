#include "step/radau_method.hpp"

#include "hbvm/error.hpp"
#include "method/hbvm_name.hpp"
#include "method/method_spec.hpp"
#include "method/radau.hpp"
#include "step/tableau_method.hpp"

namespace hbvm::core {
namespace {

class RadauMethod final : public MethodByTemplate<RadauMethod> {
 public:
  RadauMethod(int s, Formulation formulation) : s_(s), formulation_(std::move(formulation)) {}

  std::string text() const override { return "radau:" + std::to_string(s_) + formulation_.suffix(); }
  std::string title() const override { return "Radau IIA(" + std::to_string(s_) + ")" + formulation_.title(); }
  int order() const override { return 2 * s_ - 1; }
  int stages() const override { return s_; }
  int terms() const override { return s_; }
  Kept kept() const override {
    const bool held = formulation_.ends_on_constraints();
    return {.energy = false, .momenta = false, .constraints = held, .hidden = held, .reversal = false};
  }
  Constants parameters() const override { return letter_s(s_); }

  template <Scalar S>
  StepperMaker<S> prepare_in(const Problem<S>& problem, SolverKind) const {
    return [&problem, method = radau<S>(s_), formulation = formulation_] {
      return std::make_unique<RungeKuttaStepper<S>>(problem, method, formulation);
    };
  }

 private:
  int s_;
  Formulation formulation_;
};

}  // namespace

MethodPtr radau_method(std::string_view arguments) {
  auto [number, formulation] = FormulatedName::parse(arguments);
  const std::optional<int> s = whole_number(number);
  if (!s || *s < 1 || *s > max_s)
    throw InputError("method radau:" + std::string(arguments) + ": use radau:S, with a whole number S from 1 to " +
                     std::to_string(max_s) + ", which may end in " + std::string(formulations));
  return std::make_shared<const RadauMethod>(*s, std::move(formulation));
}

}  // namespace hbvm::core
