#pragma once

#include <functional>
#include <string>
#include <vector>

#include "hbvm/scalar/precision.hpp"

namespace hbvm {

/// How a study's results compare with what it states.
struct Agreement {
  long agreed = 0, stated = 0;           ///< figures of expected.csv that were met, and in all
  std::string what;                      ///< "printed figures", "stated bounds" or "stated verdicts"
  long further_agreed = 0, further = 0;  ///< beyond double: round-off columns and rates that double cannot show
  std::vector<std::string> complaints;   ///< one line for each that was not met
};

/// What a study found.
struct StudyOutcome : Agreement {
  std::string title;
  std::vector<std::string> files;  ///< tables and pictures written
  std::string table;               ///< in Markdown
};

/// Runs the experiment that the folder's study.toml describes, in one precision. Tables (CSV, Markdown, LaTeX) go to
/// results/PRECISION/ in the folder, pictures (SVG) too.
/// \param check compare with the folder's expected.csv
/// \param progress called with (runs done, runs in all)
/// \throws InputError, IntegrationError
StudyOutcome run_study(const std::string& folder, const Precision& precision, bool check,
                       const std::function<void(long, long)>& progress);

}  // namespace hbvm
