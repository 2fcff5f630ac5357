#pragma once

#include <optional>
#include <string>
#include <vector>

#include "audit/finding.hpp"
#include "long_work/cells.hpp"
#include "scalar/expression.hpp"

namespace hbvm::core {

struct AuditOptions : CellOptions {
  int starts = 2;          ///< consistent states over which the greatest error is taken
  int first_start = 0;     ///< which states: 0, 1, … lie on the motion one after the other
  int log2_interval = -1;  ///< errors over an interval are those over 2^log2_interval of the motion's time scale
  /// All of the motion up to this time is looked at, in the scene's units.
  std::optional<Expression> until{};
  long most_steps = 1'024;  ///< of an interval; more in proportion with `until`
  double limit = 120;       ///< seconds of processor time a claim may take; 0: any
  /// In which the coefficients are held against their conditions; 0: not at all.
  int coefficient_digits = 1'000;
};

/// What makes two claims the same: everything but the label.
std::string key_of(const Claim& claim);

/// Decides each claim. Claims about one method on one problem share their runs. While a claim is undecided, the
/// precision is raised from double over quad to mpfr:50, 100, 200 and 400. Errors of one step are always looked at down
/// to 100 digits, so that a coefficient wrong in its 25th shows. The coefficients themselves are looked at in 1000.
/// What is claimed to be exact is looked at in as many digits as an error of the method would need to show. Steps and
/// intervals are parts of the motion's own time scale. The error is measured against a closed form or a run by another
/// solver, whose own error is estimated. That run has at least four more stages and 24 more digits. \return a finding a
/// claim, in order: what cannot be run is found to be so. Of a shard, the findings of its claims alone
std::vector<Finding> audit(const std::vector<Claim>& claims, const AuditOptions& options);

}  // namespace hbvm::core
