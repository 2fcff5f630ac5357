#pragma once

#include <atomic>

#include "hbvm/error.hpp"

namespace hbvm {

/// The number of a signal that asks runs to end, 0 if none does. A signal handler may set it; integrate() looks at it
/// after every step, and steps that are made of parts after every part.
inline std::atomic<int> interruption{0};
static_assert(std::atomic<int>::is_always_lock_free, "else a signal handler may not set it");

/// A signal ended a run between two steps, or within one. The steps before have been shown to the observers.
class Interrupted : public Error {
 public:
  Interrupted(int signal, const std::string& what) : Error(what), signal_(signal) {}
  int signal() const { return signal_; }

 private:
  int signal_;
};

/// For work that takes long, again and again. \throws Interrupted if a signal asks for the end
inline void end_on_signal(const char* what) {
  if (const int signal = interruption) throw Interrupted(signal, what);
}

}  // namespace hbvm
