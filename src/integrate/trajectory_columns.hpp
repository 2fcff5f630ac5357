#pragma once

#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace hbvm::core {

/// A column of a trajectory.
struct TrajectoryColumn {
  std::string name;         ///< "upper.px", on one line whatever the body is called
  std::string description;  ///< what it is, with its formula
};

/// The columns that Trajectory writes, in order: t; "upper.x", ... of q; "upper.px", ... of p; "lambda1", ... of (57).
/// Then the output state's, as "output.upper.px" and "output.lambda1"; delta_H, g and hidden; and the scene's
/// observations by their names.
/// \param constraints what each multiplier belongs to, as names_of_constraints() says it
/// \throws InputError for an observation that has the name of another column
std::vector<TrajectoryColumn> trajectory_columns(const Scene& scene, const std::vector<std::string>& constraints);

/// Their names alone.
std::vector<std::string> names_of(const std::vector<TrajectoryColumn>& columns);

}  // namespace hbvm::core
