#pragma once

#include "scalar/in_place.hpp"
#include "step/stepper.hpp"

namespace hbvm::core {

/// Steps back in time. H is even in p, so a step back is one of another stepper forward from (q, -p), with p reversed
/// again. The multiplier is the same. With forces without a potential, or driven points, it is one of size -h.
template <Scalar S>
class BackwardStepper final : public ForwardingStepper<S> {
 public:
  using ForwardingStepper<S>::ForwardingStepper;

  StepResult<S> step(State<S>& state, const S& h) override {
    if (!this->problem().is_conservative()) return this->inner().step(state, S(-h));
    const Reversal reversal(state);
    StepResult<S> result = this->inner().step(state, h);
    result.reversed = !result.reversed;
    return result;
  }

 private:
  /// For as long as it lives.
  class Reversal {
   public:
    explicit Reversal(State<S>& state) : state_(state) { reverse(); }
    ~Reversal() { reverse(); }
    Reversal(const Reversal&) = delete;

   private:
    void reverse() {
      for (Vector<S>* const p : {&state_.p, &state_.p_carry})
        for (Index j = 0; j < p->size(); ++j) set_negative((*p)[j], (*p)[j]);
    }
    State<S>& state_;
  };
};

}  // namespace hbvm::core
