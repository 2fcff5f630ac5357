#pragma once

#include <streambuf>
#include <string>

#include "hbvm/run.hpp"

namespace hbvm::core {

/// Where the CSV lines of a trajectory go that is kept in memory: it has the row as soon as a line ends.
class TrajectoryLines final : public std::streambuf {
 public:
  /// The rows until now, which are given away.
  hbvm::Trajectory take() { return std::move(trajectory_); }

 protected:
  std::streamsize xsputn(const char* text, std::streamsize count) override;
  int_type overflow(int_type letter) override;

 private:
  void end_line();

  std::string line_;
  hbvm::Trajectory trajectory_;
};

}  // namespace hbvm::core
