#pragma once

#include <string>

#include "scene/assemble.hpp"

namespace hbvm::core {

/// What an audit must know of a motion before it looks at a method: it depends on the problem alone.
struct Motion {
  /// log2 of the time in which the fastest part of the motion changes. It is at most four over the spectral radius of
  /// the linearised equations of motion. It is so short that a step of four stages resolves the motion.
  int log2_scale = 0;
  /// Why the motion says nothing about a method, else empty. It is that all bodies are at rest or in uniform motion, or
  /// in a relative equilibrium, where whole terms of the error vanish.
  std::string degenerate = {};
  /// Every body moves on a straight line: no angular momentum is tried.
  bool straight = false;
  bool has_closed_form = false;
};

/// \throws InputError, IntegrationError, StageFailure
Motion motion_of(const std::string& scene);

}  // namespace hbvm::core
