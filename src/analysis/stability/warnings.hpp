#pragma once

#include <string>
#include <vector>

#include "hbvm/analysis/run.hpp"

namespace hbvm {

/// What a run says against itself, by the names of its warnings. Until a run carries them: that the number of nodes it
/// chose does not hold counts as energy_lost, and `pending` says that no other could have been given.
struct Warnings {
  std::vector<std::string> names;
  bool pending = true;
};

inline Warnings warnings_of(const RunResult& result) {
  Warnings warnings;
  if (!result.choice_verified) warnings.names.emplace_back("energy_lost");
  return warnings;
}

}  // namespace hbvm
