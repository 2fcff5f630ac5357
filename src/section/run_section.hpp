#pragma once

#include <optional>
#include <vector>

#include "hbvm/section.hpp"
#include "long_work/cells.hpp"
#include "run/run_request.hpp"
#include "section/starts.hpp"

namespace hbvm::core {

/// A section as it is asked for, read: the run that each orbit is, and the starts.
struct SectionWork {
  RunRequest request;  ///< its scene has the plane as its one event, and the axes as its two observations
  std::string plane, direction, x, y;
  std::vector<VariedNumber> numbers;  ///< that starts differ by
  std::vector<VariedScene> starts;
  std::string command;
};

/// The run of one start.
RunRequest orbit_request(const SectionWork& work, std::size_t start);

/// Runs the orbits, a cell each.
/// \return what section() does; nothing if some orbits are those of other shards \throws as section() does
std::optional<Section> run_section(const SectionWork& work, const CellOptions& options);

}  // namespace hbvm::core
