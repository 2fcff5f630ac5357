#pragma once

#include <functional>
#include <string>
#include <vector>

#include "hbvm/analysis/stability/case.hpp"

namespace hbvm {

struct StabilityOptions {
  int jobs = 1;  ///< processes
  /// Findings known from before, by their cases' keys, and what is told of new ones.
  std::function<const CaseFinding*(const std::string& key)> known;
  std::function<void(const std::string& key, const CaseFinding&)> found;
  std::function<void(long, long)> progress;  ///< (cases decided, of)
};

/// Runs and judges each case, in a process of its own: one that crashes or finds no end is not as expected, and takes
/// no other with it. To be called while the program has a single thread.
/// \return a finding a case, in order \throws Error if a process cannot be started
std::vector<CaseFinding> stability(const std::vector<HardCase>& cases, const StabilityOptions& options);

}  // namespace hbvm
