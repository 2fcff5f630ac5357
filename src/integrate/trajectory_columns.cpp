#include "integrate/trajectory_columns.hpp"

#include <algorithm>

#include "scene/coordinate_names.hpp"

namespace hbvm::core {
namespace {

/// A name may hold anything; readers that skip one line of names want one.
std::string on_one_line(std::string name) {
  for (char& c : name)
    if (c == '\n' || c == '\r') c = ' ';
  return name;
}

}  // namespace

std::vector<TrajectoryColumn> trajectory_columns(const Scene& scene, const std::vector<std::string>& constraints) {
  const std::vector<std::string> q = coordinate_names(scene), p = coordinate_names(scene, "p");
  std::vector<TrajectoryColumn> columns{{"t", "time"}};
  const auto add = [&](const std::string& name, const std::string& description) {
    columns.push_back({on_one_line(name), description});
  };
  const auto multipliers = [&](const std::string& state, const std::string& what) {
    for (std::size_t i = 0; i < constraints.size(); ++i)
      add(state + "lambda" + std::to_string(i + 1), what + " of the constraint '" + constraints[i] + "'");
  };
  for (std::size_t i = 0; i < q.size(); ++i) add(q[i], "coordinate " + std::to_string(i + 1) + " of q");
  for (std::size_t i = 0; i < p.size(); ++i)
    add(p[i], "momentum " + std::to_string(i + 1) + " of p = M dq/dt, as the method propagates it");
  multipliers("", "Lagrange multiplier, as the method extrapolates it,");
  for (std::size_t i = 0; i < p.size(); ++i)
    add("output." + p[i],
        "momentum " + std::to_string(i + 1) + " of the output state: p projected to the tangent space");
  multipliers("output.", "Lagrange multiplier of the output state,");
  add("delta_H", "H(q, p) - H(q_0, p_0), with H = 1/2 p^T M^-1 p - U(q)");
  add("g", "greatest |g_i(q)| of the constraints");
  add("hidden", "greatest |grad g_i(q)^T M^-1 p| of the hidden constraints");
  for (const SceneObservation& observation : scene.observations) {
    const std::string name = on_one_line(observation.name);
    if (std::any_of(columns.begin(), columns.end(), [&](const TrajectoryColumn& c) { return c.name == name; }))
      throw InputError(scene.name + ": observe '" + name +
                       "': a column of the trajectory is called so; take another name");
    add(name, "observed of the output state: " + on_one_line(observation.value.text()));
  }
  return columns;
}

std::vector<std::string> names_of(const std::vector<TrajectoryColumn>& columns) {
  std::vector<std::string> names;
  for (const TrajectoryColumn& column : columns) names.push_back(column.name);
  return names;
}

}  // namespace hbvm::core
