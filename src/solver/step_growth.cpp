#include "solver/step_growth.hpp"

#include "interruption.hpp"
#include "scalar/binary_exponent.hpp"
#include "scalar/in_place.hpp"
#include "solver/newton_starts.hpp"

namespace hbvm::core {

template <Scalar S>
long grow(NewtonIteration<S>& iteration, BranchGuard<S>& guard, const StepStart<S>& from, int halvings) {
  // Steps grow by factors of 1 + growth.
  constexpr int least_growth_bits = 6;
  StageUnknowns<S>& x = iteration.unknowns();
  S h = from.h * power_of_two<S>(-halvings), growth = 1, solved = 0;
  long sweeps = 0;
  Matrix<S> gamma, lambda;  // of the last step that was solved
  // The multipliers, too, are those of the shortest step: of a body at rest they tell how far it may move.
  iteration.begin(from, h);
  NewtonStarts<S>::set_constant(iteration.equations(), x);
  for (bool first = true;; first = false) {
    // There may be a thousand shorter steps.
    if (!first) end_if_asked("the solution was not followed from shorter steps");
    try {
      iteration.begin(from, h);
      iteration.forget_jacobian();
      sweeps += iteration.run();
      if (first) {
        guard.start(iteration.equations(), iteration.start());
        if (guard.is_far(x))
          throw StageFailure(FailureCause::stage_equations_diverge,
                             "even much shorter steps have no solution near their start", "1", sweeps);
      }
      if (!(h < from.h)) return sweeps;
      gamma = x.gamma;
      lambda = x.lambda;
      if (growth < 1) growth = 2 * growth;
    } catch (const StageFailure& failure) {
      growth = growth / 2;
      if (first || growth < power_of_two<S>(-least_growth_bits))
        throw StageFailure(failure.cause(), failure.what(), failure.increment(), sweeps + failure.sweeps());
      sweeps += failure.sweeps();
      h = solved;
    }
    solved = h;
    h = h * (1 + growth);
    if (!(h < from.h)) h = from.h;
    x.lambda = lambda;
    // The degree j of v grows with the step to the power j.
    S power = 1;
    for (Index j = 0; j < x.gamma.rows(); ++j) {
      for (Index i = 0; i < x.gamma.cols(); ++i) x.gamma(j, i) = gamma(j, i) * power;
      power = power * (h / solved);
    }
  }
}

#define HBVM_DEFINE(S) template long grow(NewtonIteration<S>&, BranchGuard<S>&, const StepStart<S>&, int);
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
