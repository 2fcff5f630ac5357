#pragma once

#include "hbvm/error.hpp"
#include "linear/matrix.hpp"
#include "scalar/archive.hpp"
#include "step/stepper.hpp"

namespace hbvm::core {

/// The solution at one mesh point. `lambda` is (57) of the step that ends there; at n = 0 that of the exact state,
/// Theorem 1.
template <Scalar S>
struct Snapshot {
  long n = 0;
  S t;
  Vector<S> q, p, lambda;
};

/// Looks at every mesh point, in order. What it throws ends the integration.
template <Scalar S>
class Observer {
 public:
  virtual ~Observer() = default;
  virtual void observe(const Snapshot<S>& snapshot) = 0;
  /// All that it gathered, for a run that goes on from a checkpoint.
  virtual void remember(Archive&) { throw InputError("--checkpoint: something that looks at this run cannot be kept"); }
};

/// Looks at every step as soon as it is made, with its polynomials.
template <Scalar S>
class StepObserver {
 public:
  virtual ~StepObserver() = default;
  /// \param end the state in which the step ends
  virtual void observe(const StepResult<S>& step, const State<S>& end) = 0;
  /// As of an Observer.
  virtual void remember(Archive& archive) = 0;
};

}  // namespace hbvm::core
