#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "hbvm/figure.hpp"
#include "long_work/cells.hpp"
#include "scalar/precision.hpp"

namespace hbvm::core {

/// How a study's results compare with what it states.
struct StudyAgreement {
  long agreed = 0, stated = 0;           ///< figures of expected.csv that were met, and in all
  std::string what;                      ///< "printed figures", "stated bounds" or "stated verdicts"
  long further_agreed = 0, further = 0;  ///< beyond double: round-off columns and rates that double cannot show
  std::vector<std::string> complaints;   ///< one line for each that was not met
};

/// What a study found.
struct StudyOutcome : StudyAgreement {
  std::string title;
  std::vector<std::string> files;     ///< tables and pictures written
  std::vector<std::string> warnings;  ///< pictures that could not be drawn, and why
  std::string table;                  ///< in Markdown
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
