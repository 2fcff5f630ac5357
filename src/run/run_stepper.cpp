#include "run/run_stepper.hpp"

#include "integrate/integrate.hpp"
#include "step/hbvm_method.hpp"

namespace hbvm::core {

OnFailure parse_on_failure(std::string_view name) {
  for (const OnFailure on_failure : {OnFailure::stop, OnFailure::halve})
    if (name == name_of(on_failure)) return on_failure;
  throw InputError("--on-failure '" + std::string(name) + "': use stop or halve");
}

std::string_view name_of(OnFailure on_failure) { return on_failure == OnFailure::stop ? "stop" : "halve"; }

namespace {

/// Of the given step, or of the first of its halves for which there is one.
template <Scalar S>
ChosenK choose_k_of_halves(const Assembled<S>& scene, const HbvmName& name, S step, SolverKind solver) {
  for (int depth = 0;; ++depth, step /= 2) {
    try {
      return choose_k(scene, name, step, solver);
    } catch (const Error&) {
      if (depth == HalvingStepper<S>::deepest) throw;
    }
  }
}

}  // namespace

template <Scalar S>
RunStepper<S>::RunStepper(const Assembled<S>& scene, MethodPtr method, const S& step, SolverKind solver,
                          OnFailure on_failure)
    : method_(std::move(method)) {
  const bool halve = on_failure == OnFailure::halve;
  const HbvmMethod* const hbvm = as_hbvm(*method_);
  const HbvmName name = hbvm ? hbvm->name() : HbvmName{};
  if (hbvm && hbvm->name().is_auto()) {
    chosen_ = halve ? choose_k_of_halves(scene, name, step, solver) : choose_k(scene, name, step, solver);
    method_ = hbvm_of({chosen_->k, name.s, chosen_->r});
  }
  const bool raise = chosen_ && !chosen_->exact;
  StepperMaker<S> plain;
  if (!raise) plain = method_->prepare(scene.problem, solver);
  const auto make = [=, this, &problem = scene.problem](int depth) -> std::unique_ptr<Stepper<S>> {
    // The smallest parts of a step are kept as they are.
    const bool divisible = halve && depth < HalvingStepper<S>::deepest;
    if (raise)
      return std::make_unique<RaisingStepper<S>>(problem, HbvmName{chosen_->k, name.s, chosen_->r}, solver, nodes_,
                                                 divisible ? OnShortage::fail : OnShortage::keep, chosen_->raises);
    return plain();
  };
  if (halve) {
    auto halving = std::make_unique<HalvingStepper<S>>(make);
    halving_ = halving.get();
    outer_ = std::move(halving);
  } else {
    outer_ = make(0);
  }
}

template <Scalar S>
StepResult<S> RunStepper<S>::step(State<S>& state, const S& h) {
  const StepResult<S> result = outer_->step(state, h);
  ++nodes_.step;
  return result;
}

#define HBVM_DEFINE(S) template class RunStepper<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
