#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <stop_token>
#include <thread>

#include "hbvm/error.hpp"

namespace hbvm::python {

/// Watches over work that goes on without Python's lock. Ctrl-C ends it, and so does an exception of the callable that
/// is told of progress. That is called some times a second, as f(done, of).
class Supervision {
 public:
  /// \param progress a callable, or None
  explicit Supervision(pybind11::object progress);
  ~Supervision();
  Supervision(const Supervision&) = delete;

  std::stop_token token() const { return stop_.get_token(); }
  /// What the work calls, from any thread.
  std::function<void(long, long)> steps();
  std::function<void(double)> parts();

  /// What the work returns. \throws what it throws, or the exception of Python that ended it
  template <class Work>
  auto of(Work&& work) {
    try {
      const pybind11::gil_scoped_release unlocked;
      return work();
    } catch (const Interrupted&) {
      raise_cause();
      throw;
    }
  }

 private:
  void watch();
  void report(double done, double of);
  void look_for_signals();
  void keep_error();
  void raise_cause();

  pybind11::object progress_;
  std::stop_source stop_;
  std::atomic<bool> due_ = false;       ///< it is time to tell of progress
  std::exception_ptr error_ = nullptr;  ///< the first of Python's
  std::mutex guards_error_;
  const std::thread::id caller_ = std::this_thread::get_id();
  bool sees_signals_ = false;  ///< Python shows them to its main thread alone
  int interrupts_before_ = 0;
  std::mutex guards_end_;
  std::condition_variable ended_;
  bool end_ = false;
  std::thread watcher_;
};

}  // namespace hbvm::python
