#pragma once

#include <functional>
#include <stop_token>
#include <string>
#include <vector>

#include "hbvm/figure.hpp"

namespace hbvm {

/// A folder with a study.toml: its runs, its tables, and what they are compared with.
struct StudyRequest {
  std::string folder, precision = "double";
  bool check = true;     ///< compare with the folder's expected.csv
  std::string out = {};  ///< where files go; results/PRECISION in the folder if empty
  /// Draws a picture into a file, by gnuplot_script() for example; without it there are none, and a warning for each.
  std::function<void(const Figure& figure, const std::string& file)> draw = {};
  int jobs = 1;                                           ///< threads
  std::function<void(long done, long of)> progress = {};  ///< called now and then, from any thread
  std::stop_token stop = {};
};

struct Study {
  std::string title, table;             ///< in Markdown
  long agreed = 0, stated = 0;          ///< figures of expected.csv that were met, and in all
  std::vector<std::string> files;       ///< tables and pictures written
  std::vector<std::string> complaints;  ///< one line for each figure that was not met
  std::vector<std::string> warnings;    ///< pictures that could not be drawn, and why
};

/// \throws InputError with file and line for a study.toml that is wrong; IntegrationError, Interrupted
Study study(const StudyRequest& request);

std::string to_json(const Study& study);

}  // namespace hbvm
