#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "hbvm/report/figure.hpp"
#include "hbvm/scene/scene.hpp"

namespace hbvm {

/// A file of results of any program: names of columns, then a line a time.
struct ResultsFile {
  std::string name, csv;
};

struct AgainstRequest {
  Scene scene;
  std::vector<ResultsFile> files;
  /// What theirs is, an expression in the names of their columns, and which of ours that is: "t", "bob.x", "bob.px" or
  /// "bob.vx". Columns of these names need not be mapped, nor "time", "q_3", "p_3" and "v_3"; of "bob.px" and
  /// "output.bob.px" of a trajectory of hbvm run the second, which is tangential, is taken.
  std::vector<std::pair<std::string, std::string>> map;
  std::function<void(double)> progress = {};
};

/// One component of one file: right digits at each time.
struct ComponentDigits {
  std::string name;
  std::vector<double> digits;
};

struct FileAgainst {
  std::string name;
  std::vector<std::string> times;   ///< those that were compared
  std::vector<std::string> unused;  ///< "2 times before the start", one a reason
  bool stored = false;              ///< the reference was found in the store, and not computed
  std::vector<ComponentDigits> components;
  /// log10 of what H and the constraints g are off by, over the size of their terms, at each time, where the state is
  /// complete; else empty.
  std::vector<double> H_drift, g_drift;
  double step = 0;   ///< between the first two times
  double error = 0;  ///< log10 of the greatest error of a component at the last time, over its vector's size
};

struct Against {
  int digits = 0;  ///< of the reference
  std::vector<FileAgainst> files;
  /// Digits that an error of the size of the first file's first would have left at its times by the growth of errors
  /// alone.
  std::vector<double> by_growth;
  /// Between one file and the next, as log of the errors' ratio over that of the steps; NaN where the steps are equal,
  /// or the last times are not.
  std::vector<double> orders;
};

/// Right digits of results beside the reference, which is found in the store or computed at their times. At most
/// `most_times` of a file are compared, evenly spaced, its last among them. \throws InputError for files, columns and
/// maps that cannot be read, naming line and column; IntegrationError
Against compare_with_reference(const AgainstRequest& request);
inline constexpr std::size_t most_times = 50;

/// Digits against time, a curve a component of the first file, and what the growth of errors alone would leave.
Figure against_figure(const AgainstRequest& request, const Against& against, const std::string& name);

}  // namespace hbvm
