#pragma once

#include <functional>
#include <string>

#include "long_work/cells.hpp"
#include "reference/compute_reference.hpp"
#include "reference/route_run.hpp"

namespace hbvm::core {

/// The state that runs are compared with, and where it is from.
struct CostReference {
  ReferenceState state;
  int digits = 0;
  std::string source;  ///< "shipped: kepler_t10_50", or the routes that were made
};

struct CostReferenceRequest {
  const Scene* scene = nullptr;
  Expression until;
  int digits = 0;              ///< at least so many
  bool confirmed = true;       ///< by two routes; else by Taylor series alone, which share nothing with any stepper
  CellStore* store = nullptr;  ///< where what was computed is kept and found again
  std::function<void(double)> progress = {};
};

/// A reference that is shipped, if one has the scene, the time and the digits; else one from the store; else computed.
/// \throws InputError, IntegrationError as compute_reference does
CostReference find_cost_reference(const CostReferenceRequest& request);

/// nature_of, kept in the store likewise.
MotionNature find_nature(const Scene& scene, const Expression& until, CellStore* store,
                         const std::function<void(double)>& progress);

}  // namespace hbvm::core
