#pragma once

#include <memory>

#include "integrate/observer.hpp"
#include "problem/state_evaluator.hpp"
#include "step/backward_stepper.hpp"

namespace hbvm::core {

/// The motion at any time near a mesh point: an output state there.
template <Scalar S>
struct StateBetween {
  S t;
  Vector<S> q, p, lambda;
};

/// Leads from a mesh point to any time by one step of the run's own method, which starts from the output state. That is
/// consistent and of order 2s, and so is the end of one step from it, whatever its size. H and g are what they are at
/// mesh points. At a mesh point it is the output state itself. (The polynomial of a step has order s + 1 alone.)
template <Scalar S>
class BetweenSteps {
 public:
  /// Makes steps of its own; the problem must outlive it.
  explicit BetweenSteps(std::unique_ptr<Stepper<S>> stepper);

  /// The output state of a mesh point.
  StateBetween<S> output(const Snapshot<S>& mesh);
  /// \param t may be before, if forces have a potential that does not depend on t
  /// \throws IntegrationError if the step cannot be made
  StateBetween<S> from(const StateBetween<S>& output, const S& t);
  /// Both in one.
  StateBetween<S> at(const Snapshot<S>& mesh, const S& t) { return from(output(mesh), t); }
  /// Whether it can lead back in time.
  bool leads_back() const { return stepper_->problem().is_conservative(); }

 private:
  std::unique_ptr<Stepper<S>> stepper_;
  BackwardStepper<S> back_;
  StateEvaluator<S> point_;
};

}  // namespace hbvm::core
