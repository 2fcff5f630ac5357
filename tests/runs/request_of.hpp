#pragma once

#include "run/run_request.hpp"
#include "step/registry.hpp"

namespace hbvm::core {

/// A run as its texts ask for it.
inline RunRequest request_of(const Scene& scene, const std::string& method, const std::string& step,
                             const std::string& until, const std::string& precision = "double",
                             SolverKind solver = SolverKind::automatic) {
  return {scene,
          parse_method(method),
          solver,
          Expression::parse(step),
          Expression::parse(until),
          Precision::parse(precision)};
}

}  // namespace hbvm::core
