#pragma once

#include "integrate/coefficient_decay.hpp"
#include "step/stepper.hpp"

namespace hbvm::core {

/// Another stepper's steps, with the solution of each shown to `decay`. Both must outlive it.
template <Scalar S>
class WatchedStepper final : public Stepper<S> {
 public:
  WatchedStepper(Stepper<S>& inner, CoefficientDecay<S>& decay) : inner_(inner), decay_(decay) {}

  const Problem<S>& problem() const override { return inner_.problem(); }
  long step(State<S>& state, const S& h) override {
    const long sweeps = inner_.step(state, h);
    if (const StageUnknowns<S>* const x = inner_.unknowns()) decay_.observe(*x, state.p);
    return sweeps;
  }
  const Vector<S>& multiplier() const override { return inner_.multiplier(); }
  const StageUnknowns<S>* unknowns() const override { return inner_.unknowns(); }
  SolverCounts counts() const override { return inner_.counts(); }
  void measure_time() override { inner_.measure_time(); }
  void remember(Archive& archive) override { archive(inner_, decay_); }

 private:
  Stepper<S>& inner_;
  CoefficientDecay<S>& decay_;
};

}  // namespace hbvm::core
