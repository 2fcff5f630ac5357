#include "step/composition.hpp"

#include "copy_state.hpp"
#include "linear/rounded.hpp"
#include "method/method_spec.hpp"
#include "step/registry.hpp"

namespace hbvm::core {
namespace {

void append_steps(std::vector<Mpfr>& steps, int order, const Mpfr& factor) {
  if (order == 2) {
    steps.push_back(factor);
    return;
  }
  const Mpfr g = 1 / (4 - pow(Mpfr(4), Mpfr(1) / (order - 1)));
  for (const Mpfr& part : {g, g, Mpfr(1 - 4 * g), g, g}) append_steps(steps, order - 2, factor * part);
}

void check_order(int order) {
  if (order < 2 || order % 2 != 0 || order > max_composition_order)
    throw InputError("the order of a composition is even, from 2 to " + std::to_string(max_composition_order) +
                     ", not " + std::to_string(order));
}

class Composition final : public MethodByTemplate<Composition> {
 public:
  Composition(MethodPtr inner, int order) : inner_(std::move(inner)), order_(order) {}

  std::string text() const override { return "compose:" + inner_->text() + "," + std::to_string(order_); }
  std::string title() const override { return inner_->title() + " composed, order " + std::to_string(order_); }
  int order() const override { return order_; }
  int stages() const override { return order_ / 2; }
  int terms() const override {
    int parts = 1;
    for (int p = 2; p < order_; p += 2) parts *= 5;
    return parts * inner_->terms();
  }
  Kept kept() const override {
    Kept kept = inner_->kept();
    kept.energy = false;
    return kept;
  }

  template <Scalar S>
  StepperMaker<S> prepare_in(const Problem<S>& problem, SolverKind solver) const {
    return [inner = inner_->prepare(problem, solver), parts = composition_steps<S>(order_)] {
      return std::make_unique<CompositionStepper<S>>(inner(), parts);
    };
  }

 private:
  MethodPtr inner_;
  int order_;
};

}  // namespace

template <Scalar S>
Vector<S> composition_steps(int order) {
  check_order(order);
  // Products of order/2 - 1 factors: g in (1/3, 0.42), and 1 - 4 g in (-0.66, -1/3). The error of 1 - 4 g is 4/(1/3)
  // times that of g at most. A level loses two digits, and there are at most max_composition_order/2 - 1 of them.
  constexpr unsigned guard = 10;
  std::vector<Mpfr> steps;
  const auto digits = static_cast<unsigned>(digits10<S>());
  {
    const PrecisionScope guarded(digits + guard);
    append_steps(steps, order, Mpfr(1));
  }
  const PrecisionScope working(digits);
  return rounded<S>(Eigen::Map<const Vector<Mpfr>>(steps.data(), static_cast<Index>(steps.size())));
}

template <Scalar S>
CompositionStepper<S>::CompositionStepper(std::unique_ptr<Stepper<S>> inner, Vector<S> parts)
    : ForwardingStepper<S>(std::move(inner)),
      parts_(std::move(parts)),
      before_(Vector<S>::Zero(this->problem().m()), Vector<S>::Zero(this->problem().m())) {}

template <Scalar S>
StepResult<S> CompositionStepper<S>::step(State<S>& state, const S& h) {
  copy_state(before_, state);
  StepResult<S> result;
  long sweeps = 0;
  for (Index i = 0; i < parts_.size(); ++i) {
    set_product(h_, parts_[i], h);
    try {
      result = this->inner().step(state, h_);
      sweeps += result.sweeps;
    } catch (const StageFailure& failure) {
      copy_state(state, before_);
      throw StageFailure(
          failure.cause(),
          "part " + std::to_string(i + 1) + " of " + std::to_string(parts_.size()) + ": " + failure.what(),
          failure.increment(), sweeps + failure.sweeps());
    }
  }
  result.sweeps = sweeps;
  return result;
}

MethodPtr composition_method(std::string_view arguments) {
  const std::size_t comma = arguments.rfind(',');
  const std::optional<int> order =
      whole_number(comma == std::string_view::npos ? std::string_view() : arguments.substr(comma + 1));
  if (!order)
    throw InputError("method compose:" + std::string(arguments) + ": use compose:rattle,P with an even order P");
  check_order(*order);
  const MethodPtr inner = parse_method(arguments.substr(0, comma));
  if (inner->order() != 2 || !inner->kept().reversal)
    throw InputError("method compose:" + std::string(arguments) + ": " + inner->text() +
                     " is not a symmetric method of order 2");
  return std::make_shared<const Composition>(inner, *order);
}

#define HBVM_DEFINE(S)                                \
  template Vector<S> composition_steps<S>(int order); \
  template class CompositionStepper<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
