#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "hbvm/study.hpp"
#include "long_work/cells.hpp"
#include "scalar/precision.hpp"

namespace hbvm::core {

/// What a study found, and how it compares with what it states.
struct StudyOutcome : hbvm::Study {
  std::string what;                      ///< "printed figures", "stated bounds" or "stated verdicts"
  long further_agreed = 0, further = 0;  ///< beyond double: round-off columns and rates that double cannot show

  /// Counts a figure that is stated, or a further one, and complains of it unless it is met.
  void count(bool is_met, const std::string& complaint, bool is_further = false) {
    ++(is_further ? further : stated);
    if (is_met)
      ++(is_further ? further_agreed : agreed);
    else
      complaints.push_back(complaint);
  }
};

/// A folder with a study.toml, and the precision to run it in.
struct StudyRequest {
  std::string folder;
  Precision precision;
};

struct StudyOptions : CellOptions {
  /// Draws a picture into a file; without it there are none, and a warning for each.
  std::function<void(const Figure&, const std::string& file)> draw = {};
  bool check = false;  ///< compare with the folders' expected.csv
  /// Where results go, in STUDY/PRECISION/; if absent to results/PRECISION/ in the study's own folder.
  std::optional<std::filesystem::path> out{};
};

/// Runs the experiments that study.toml describes: a cell for each of their runs. Tables (CSV, Markdown, LaTeX, and a
/// CSV with all digits) and pictures (SVG, with the trajectories they show) come out. They are the same whatever the
/// number of threads and shards, but for a column of seconds. If a run fails, the studies that are complete are written
/// all the same.
/// \return an outcome a request, in order; none for one with runs in other shards that the store does not know
/// \throws InputError, before anything is run if a study.toml is wrong; IntegrationError
std::vector<std::optional<StudyOutcome>> run_studies(const std::vector<StudyRequest>& requests,
                                                     const StudyOptions& options);

}  // namespace hbvm::core
