#pragma once

#include <functional>
#include <string>
#include <vector>

#include "hbvm/analysis/audit/claim.hpp"

namespace hbvm {

struct AuditOptions {
  int jobs = 1;             ///< threads
  int starts = 2;           ///< consistent states over which the greatest error is taken
  int first_start = 0;      ///< which states: 0, 1, … lie on the motion one after the other
  int log2_interval = -1;   ///< errors over an interval are those over [0, 2^log2_interval]
  long most_steps = 1'024;  ///< of an interval
  /// Findings known from before, by their claims' keys, and what is told of new ones (by one thread at a time).
  std::function<const Finding*(const std::string& key)> known;
  std::function<void(const Finding&)> found;
  std::function<void(long, long)> progress;  ///< (claims decided, of)
};

/// What makes two claims the same: everything but the label.
std::string key_of(const Claim& claim);

/// Decides each claim. Those about one method on one problem share their runs; precision is raised from double over
/// quad to mpfr:50, 100, 200 and 400 as long as a claim is undecided. Errors of one step are always looked at down to
/// 100 digits, so that a coefficient wrong in its 25th shows. The error is measured against a closed form or a run with
/// at least four more stages, by another solver, in 24 more digits, whose own error is estimated. \return a finding a
/// claim, in order \throws InputError for a problem that cannot be read, or a claim that makes no sense for it
std::vector<Finding> audit(const std::vector<Claim>& claims, const AuditOptions& options);

}  // namespace hbvm
