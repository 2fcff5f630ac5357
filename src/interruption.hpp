#pragma once

#include <atomic>
#include <cstring>
#include <stop_token>
#include <string>

#include "hbvm/error.hpp"

namespace hbvm::core {

/// Who may ask the work of a thread to end: a token, or a signal whose handler sets a number.
struct StopRequest {
  std::stop_token token = {};
  const std::atomic<int>* signal = nullptr;  ///< 0 until one comes; must outlive the work

  bool asked() const { return token.stop_requested() || number() != 0; }
  /// Of the signal; 0 if none came.
  int number() const { return signal ? signal->load(std::memory_order_relaxed) : 0; }
};
static_assert(std::atomic<int>::is_always_lock_free, "else a signal handler may not set it");

/// That of this thread; null if nobody can ask. It is looked at after every step, and in steps of parts after every
/// part. Threads that are started take over that of the thread that starts them.
inline thread_local const StopRequest* stop_request = nullptr;

inline bool stop_asked() { return stop_request && stop_request->asked(); }

/// While it lives, `request` is that of this thread.
class StopScope {
 public:
  explicit StopScope(const StopRequest* request) : before_(stop_request) { stop_request = request; }
  ~StopScope() { stop_request = before_; }
  StopScope(const StopScope&) = delete;

 private:
  const StopRequest* before_;
};

/// "SIGINT", or "signal 2" where the C library has no names.
inline std::string name_of_signal(int signal) {
#ifdef __GLIBC__
  return std::string("SIG") + sigabbrev_np(signal);
#else
  return "signal " + std::to_string(signal);
#endif
}

/// For work that takes long, again and again. \throws Interrupted if it is asked to end
inline void end_if_asked(const char* what) {
  if (stop_asked()) throw Interrupted(stop_request->number(), what);
}

}  // namespace hbvm::core
