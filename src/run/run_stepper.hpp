#pragma once

#include <optional>

#include "run/choose_k.hpp"
#include "step/halving_stepper.hpp"
#include "step/method.hpp"
#include "step/raising_stepper.hpp"

namespace hbvm::core {

/// What to do with a step that cannot be made.
enum class OnFailure {
  stop,  ///< the run ends
  halve  ///< it is made of smaller ones, see HalvingStepper
};
/// \throws InputError for an unknown name
OnFailure parse_on_failure(std::string_view name);
std::string_view name_of(OnFailure on_failure);

/// Makes the steps of a run by the method named. The k of hbvm:auto is chosen, and raised where it must be. Steps that
/// fail are divided, if that is asked for.
template <Scalar S>
class RunStepper final : public Stepper<S> {
 public:
  /// The scene must outlive it.
  /// \throws InputError, StepError as choose_k does; if steps may be divided, k is chosen for the first that can be
  /// made
  RunStepper(const Assembled<S>& scene, MethodPtr method, const S& step, SolverKind solver, OnFailure on_failure);

  RunStepper(const RunStepper&) = delete;

  const Problem<S>& problem() const override { return outer_->problem(); }
  StepResult<S> step(State<S>& state, const S& h) override;
  SolverCounts counts() const override { return outer_->counts(); }
  void remember(Archive& archive) override { archive(*outer_, nodes_); }

  /// With k as chosen.
  const MethodPtr& method() const { return method_; }
  const std::optional<ChosenK>& chosen() const { return chosen_; }
  const NodeLog& nodes() const { return nodes_; }
  /// Null unless steps may be divided.
  const HalvingLog* halving() const { return halving_ ? &halving_->log() : nullptr; }

 private:
  MethodPtr method_;
  std::optional<ChosenK> chosen_;
  NodeLog nodes_;
  std::unique_ptr<Stepper<S>> outer_;
  HalvingStepper<S>* halving_ = nullptr;
};

}  // namespace hbvm::core
