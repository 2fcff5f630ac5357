#pragma once

#include <optional>
#include <vector>

#include "cost/cost_grid.hpp"
#include "cost/cost_reference.hpp"
#include "cost/energy_cost.hpp"
#include "cost/step_time.hpp"
#include "long_work/cells.hpp"

namespace hbvm::core {

struct CostOptions : CellOptions {
  std::function<void(double)> reference_progress = {};  ///< it may throw to end the work
  RunApart apart = {};  ///< if there is none, cells run in threads, and none is ended for its time
};

/// A cell with what it came to.
struct CostFinding {
  CostCell cell;
  CostMeasurement measured;
};

struct CostOutcome {
  MotionNature nature;
  CostReference reference;
  std::size_t cells = 0;              ///< of the whole study
  std::vector<CostFinding> findings;  ///< of the shard: by precision, method and steps
  bool complete = false;              ///< all cells are there, those of steps and energy, too
  std::vector<StepTime> step_times = {};
  std::vector<EnergyCost> energies = {}, conserving = {};
  std::optional<Expression> energy_until = {};  ///< of the energies
};

/// Measures the cells of the study, each apart from the others, beside which a calibration shows what else the
/// machine did. To be called while the program has a single thread.
/// \return the same whatever the number of processes and shards, but for times
/// \throws InputError, IntegrationError
CostOutcome run_cost_study(const CostStudy& study, const CostOptions& options);

}  // namespace hbvm::core
