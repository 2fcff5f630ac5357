#pragma once

#include <string>

#include "scene/assemble.hpp"

namespace hbvm::core {

/// What an audit must know of a motion before it looks at a method: it depends on the problem alone.
struct Motion {
  /// log2 of the time in which the fastest of it changes: at most four over the spectral radius of the linearised
  /// equations of motion, and so short that a step of four stages resolves it.
  int log2_scale = 0;
  /// Why the motion says nothing about a method, else empty: all bodies at rest or in uniform motion, or a relative
  /// equilibrium, where whole terms of the error vanish.
  std::string degenerate = {};
  /// Every body moves on a straight line: no angular momentum is tried.
  bool straight = false;
  bool has_closed_form = false;
};

/// \throws InputError, IntegrationError, StageFailure
Motion motion_of(const std::string& scene);

}  // namespace hbvm::core
