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
#include "run/error_estimate.hpp"
#include "run/health.hpp"
#include "run/recording.hpp"
#include "run/run_request.hpp"
#include "run/shadow.hpp"

namespace hbvm::core {

/// What came out, every number of the working precision as decimal text that reads back exactly.
struct RunResult {
  MethodPtr method;                      ///< with k as chosen
  std::optional<NodesReport> nodes;      ///< if k was chosen
  std::optional<HalvingReport> halving;  ///< if steps might be divided
  std::string settled;                   ///< Assembled::settled
  std::string step, until, t;
  long steps = 0;
  std::vector<std::string> q, p, lambda;             ///< lambda: (57)
  std::vector<std::string> q_carry, p_carry;         ///< what rounding took from q and p
  std::vector<std::string> output_p, output_lambda;  ///< the output state
  std::string output_delta_H;                        ///< H(q, output p) - H_0
  std::string e_H, e_g, e_hid;
  double iterations_per_step = 0, cpu_seconds = 0;
  Account account;
  Health health;
  std::optional<Shadow> shadow;
  std::optional<ErrorEstimate> error;
  std::vector<Observed> observables;  ///< those the scene names: the energy, conserved components of momenta
};

struct RunHooks {
  std::ostream* trajectory = nullptr;                  ///< the CSV lines go here, if they go to no file
  std::function<std::unique_ptr<CsvFile>()> open_csv;  ///< called once the request is known to be right
  std::function<void(const std::vector<TrajectoryColumn>&)> describe_csv;  ///< called once it is open, if there is one
  long every = 1;                                                          ///< mesh points a CSV line
  std::function<void(long, long)> progress;                                ///< (steps made, of)
  Checkpoints* checkpoints = nullptr;                                      ///< where the run is kept, if it is
  Recording* recording = nullptr;  ///< filled for a picture, also of a run that fails on the way
};

/// \throws InputError, IntegrationError, Interrupted
RunResult run(const RunRequest& request, const RunHooks& hooks);

}  // namespace hbvm::core
