#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hbvm/run.hpp"
#include "integrate/checkpoint.hpp"
#include "integrate/csv_file.hpp"
#include "integrate/trajectory_columns.hpp"
#include "run/account.hpp"
#include "run/recording.hpp"
#include "run/run_request.hpp"

namespace hbvm::core {

struct RunHooks {
  std::ostream* trajectory = nullptr;                  ///< the CSV lines go here, if they go to no file
  std::function<std::unique_ptr<CsvFile>()> open_csv;  ///< called once the request is known to be right
  std::function<void(const std::vector<TrajectoryColumn>&)> describe_csv;  ///< called once it is open, if there is one
  long every = 1;                                                          ///< mesh points a CSV line
  std::function<void(long, long)> progress;                                ///< (steps made, of)
  Checkpoints* checkpoints = nullptr;                                      ///< where the run is kept, if it is
  Recording* recording = nullptr;  ///< filled for a picture, also of a run that fails on the way
  Account* account = nullptr;      ///< filled if the request asks for it
};

/// Without trajectory, pictures and the command, which are whose who asks.
/// \throws InputError, IntegrationError, Interrupted
Run run(const RunRequest& request, const RunHooks& hooks);

}  // namespace hbvm::core
