#pragma once

#include "step/method.hpp"

namespace hbvm::core {

/// The step sizes, relative to the whole, of the symmetric composition of order P = 2, 4, 6, ... of a symmetric method
/// of order 2. They are five steps of the composition of order P - 2, the third one backwards,
///
///     g, g, 1 - 4 g, g, g,   g = 1 / (4 - 4^(1/(P - 1))),
///
/// and so on down to order 2 (Suzuki 1990; Hairer, Lubich, Wanner: Geometric Numerical Integration, II.4, (4.5)).
/// 5^(P/2 - 1) numbers of sum 1, computed with guard digits and rounded once.
/// \throws InputError unless P is even and 2 <= P <= max_composition_order
template <Scalar S>
Vector<S> composition_steps(int order);

inline constexpr int max_composition_order = 12;

/// Makes a step of parts of these sizes, one after the other, by another stepper.
template <Scalar S>
class CompositionStepper final : public ForwardingStepper<S> {
 public:
  CompositionStepper(std::unique_ptr<Stepper<S>> inner, Vector<S> parts);

  StepResult<S> step(State<S>& state, const S& h) override;

 private:
  Vector<S> parts_;
  State<S> before_;
  S h_ = 0;
};

/// compose:INNER,P from "INNER,P", INNER being symmetric and of order 2: "rattle,6". \throws InputError
MethodPtr composition_method(std::string_view arguments);

}  // namespace hbvm::core
