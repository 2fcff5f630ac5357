#pragma once

#include <functional>

#include "hbvm/run.hpp"
#include "integrate/time_grid.hpp"
#include "method/hbvm_name.hpp"
#include "scene/scene.hpp"
#include "step/state.hpp"

namespace hbvm::core {

/// The steps of a run of HBVM(k, s) from the start of a scene.
struct StepsToProve {
  const Scene& scene;
  HbvmName method;
  Expression step, until;
  Direction direction = Direction::forward;
  int digits = 0;                                 ///< that are to be proved
  std::function<void(long, long)> progress = {};  ///< (steps made, of)
};

/// Proves them with as many digits as that takes, see ProvedCourse. \param end  where the run ended
/// \throws InputError for a start that is consistent to its own digits only, and for one with too many digits to take
/// \throws IntegrationError, with the time, at a step that cannot be proved; Interrupted
ProvedSteps prove_steps(const StepsToProve& steps, const State<Mpfr>& end);

}  // namespace hbvm::core
