#pragma once

#include <chrono>
#include <ctime>
#include <string>

namespace hbvm::core {

/// Elapsed time in seconds, cheap enough to read around every part of a sweep.
inline double elapsed_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Processor time of this thread in seconds, or in a browser, which tells of none, elapsed time. A call costs a system
/// call: for whole blocks of steps.
inline double thread_seconds() {
#ifdef __EMSCRIPTEN__
  return elapsed_seconds();
#else
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  constexpr long nanoseconds = 1'000'000'000;
  return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) / nanoseconds;
#endif
}

/// The day in UTC, as "2026-11-28".
inline std::string today() {
  const std::time_t now = std::time(nullptr);
  std::tm date{};
  gmtime_r(&now, &date);
  char text[sizeof "2026-11-28"];
  return {text, std::strftime(text, sizeof text, "%F", &date)};
}

/// While one lives, the time of each part of this thread's steps is measured. It costs two readings of the clock a
/// part.
class MeasuredParts {
 public:
  MeasuredParts() : before_(on_) { on_ = true; }
  ~MeasuredParts() { on_ = before_; }
  MeasuredParts(const MeasuredParts&) = delete;

  static bool on() { return on_; }

 private:
  static constinit inline thread_local bool on_ = false;
  bool before_;
};

/// Adds the time for which it lives to `seconds`, where parts are measured.
class PartTimer {
 public:
  [[gnu::always_inline]] explicit PartTimer(double& seconds)
      : seconds_(MeasuredParts::on() ? &seconds : nullptr), before_(seconds_ ? elapsed_seconds() : 0) {}
  [[gnu::always_inline]] ~PartTimer() {
    if (seconds_) *seconds_ += elapsed_seconds() - before_;
  }
  PartTimer(const PartTimer&) = delete;

 private:
  double* seconds_;
  double before_;
};

}  // namespace hbvm::core
