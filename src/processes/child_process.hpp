#pragma once

#include <sys/types.h>

#include <functional>
#include <string>

namespace hbvm::core {

/// A function at work in a process of its own, which may crash, or be ended after so many seconds of processor time.
/// Its text comes back through a pipe.
class ChildProcess {
 public:
  /// \throws Error if no process can be started
  ChildProcess(const std::function<std::string()>& work, double seconds);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;

  /// What to wait for: readable when there is text, or the end.
  int file() const { return file_; }
  /// Takes what can be read. \return whether the process has ended
  bool take();

  /// After the end: the whole text; or empty, and how it ended in `failure`.
  const std::string& text() const { return text_; }
  const std::string& failure() const { return failure_; }
  double cpu_seconds() const { return cpu_seconds_; }

 private:
  pid_t process_ = -1;
  int file_ = -1;
  double seconds_, cpu_seconds_ = 0;
  std::string text_, failure_;
};

}  // namespace hbvm::core
