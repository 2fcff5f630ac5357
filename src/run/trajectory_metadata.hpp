#pragma once

#include <string>
#include <vector>

#include "integrate/trajectory_columns.hpp"
#include "report/csvw.hpp"
#include "run/run_request.hpp"

namespace hbvm::core {

/// What describes the trajectory of a run: the program, what it was asked for, and the scene itself as dc:source.
/// \param command that makes it again; \param every mesh points a line
CsvMetadata trajectory_metadata(const RunRequest& request, const std::vector<TrajectoryColumn>& columns,
                                const std::string& command, long every);

}  // namespace hbvm::core
