#pragma once

#include <chrono>
#include <functional>
#include <string>

namespace hbvm::core {

/// A bar on standard error for work that takes longer than a second, if standard error is a terminal.
class ProgressBar {
 public:
  explicit ProgressBar(std::string what);
  ~ProgressBar();
  void update(long done, long total);
  /// Shows which part of the work is done, as it is told, and lets signals end it. \param unfinished what is said then
  std::function<void(double)> part_done(std::string unfinished);

 private:
  std::string what_;
  bool terminal_, shown_ = false;
  long first_ = -1;  ///< done when it was first shown
  std::chrono::steady_clock::time_point start_, last_;
};

}  // namespace hbvm::core
