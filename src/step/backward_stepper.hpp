#pragma once

#include "scalar/in_place.hpp"
#include "step/stepper.hpp"

namespace hbvm::core {

/// Steps back in time. H is even in p, so a step back is one of another stepper forward from (q, -p), with p reversed
/// again. The multiplier is the same.
template <Scalar S>
class BackwardStepper final : public Stepper<S> {
 public:
  /// It must outlive this one.
  explicit BackwardStepper(Stepper<S>& forward) : forward_(forward) {}

  const Problem<S>& problem() const override { return forward_.problem(); }

  long step(State<S>& state, const S& h) override {
    const Reversal reversal(state);
    return forward_.step(state, h);
  }

  const Vector<S>& multiplier() const override { return forward_.multiplier(); }
  const StageUnknowns<S>* unknowns() const override { return forward_.unknowns(); }
  SolverCounts counts() const override { return forward_.counts(); }
  void measure_time() override { forward_.measure_time(); }
  void remember(Archive& archive) override { archive(forward_); }

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

  Stepper<S>& forward_;
};

}  // namespace hbvm::core
