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
  RadauMethod(int s, OnConstraints on_constraints) : s_(s), on_constraints_(on_constraints) {}

  std::string text() const override { return "radau:" + std::to_string(s_) + (projects() ? "+project" : ""); }
  std::string title() const override {
    return "Radau IIA(" + std::to_string(s_) + ")" + (projects() ? ", projected" : "");
  }
  int order() const override { return 2 * s_ - 1; }
  int stages() const override { return s_; }
  int terms() const override { return s_; }
  Kept kept() const override {
    return {.energy = false, .momenta = false, .constraints = projects(), .hidden = projects(), .reversal = false};
  }
  Constants parameters() const override { return letter_s(s_); }

  template <Scalar S>
  StepperMaker<S> prepare_in(const Problem<S>& problem, SolverKind) const {
    return [&problem, method = radau<S>(s_), on_constraints = on_constraints_] {
      return std::make_unique<RungeKuttaStepper<S>>(problem, method, on_constraints);
    };
  }

 private:
  bool projects() const { return on_constraints_ == OnConstraints::project; }

  int s_;
  OnConstraints on_constraints_;
};

}  // namespace

MethodPtr radau_method(std::string_view arguments) {
  const auto [number, on_constraints] = TableauArguments::parse(arguments);
  const std::optional<int> s = whole_number(number);
  if (!s || *s < 1 || *s > max_s)
    throw InputError("method radau:" + std::string(arguments) + ": use radau:S, or radau:S+project, with a whole " +
                     "number S from 1 to " + std::to_string(max_s));
  return std::make_shared<const RadauMethod>(*s, on_constraints);
}

}  // namespace hbvm::core
