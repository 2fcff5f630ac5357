#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "integrate/event_finder.hpp"
#include "integrate/time_grid.hpp"
#include "run/run_stepper.hpp"
#include "run/start_state.hpp"
#include "scalar/precision.hpp"
#include "scene/scene.hpp"
#include "solver/solver_kind.hpp"

namespace hbvm::core {

/// One run as a user asks for it.
struct RunRequest {
  Scene scene;
  MethodPtr method;
  SolverKind solver = SolverKind::automatic;
  Expression step, until;
  Precision precision;
  bool account = false;  ///< measure where the time goes
  bool shadow = false;   ///< repeat the run with 16 more digits
  bool error = false;    ///< repeat it with more stages, too
  bool prove = false;    ///< prove what its steps are without rounding
  OnFailure on_failure = OnFailure::stop;
  Direction direction = Direction::forward;
  std::optional<StartState> start = {};                    ///< instead of that of the scene
  std::vector<std::array<std::string, 2>> portraits = {};  ///< observations of the scene, drawn against each other
  bool linear_energy = false;                              ///< pictures also show H - H_0 on a linear axis
  std::vector<Expression> at = {};                         ///< times at which the state is to be told, too
  std::optional<Expression> every_time = {};               ///< and the multiples of this
  std::optional<LastEvent> until_event = {};               ///< the run ends where it comes, if it does
  bool horizon = false;                                    ///< follow the growth of a change of the start
};

}  // namespace hbvm::core
