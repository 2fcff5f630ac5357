#pragma once

#include <chrono>
#include <ctime>

namespace hbvm::core {

/// Processor time of this thread in seconds. A call costs a system call: for whole blocks of steps.
inline double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  constexpr long nanoseconds = 1'000'000'000;
  return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) / nanoseconds;
}

/// Elapsed time in seconds, cheap enough to read around every part of a sweep.
inline double elapsed_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace hbvm::core
