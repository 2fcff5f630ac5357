#pragma once

#include <atomic>

#include "hbvm/error.hpp"

namespace hbvm {

/// The number of a signal that asks runs to end, 0 if none does. A signal handler may set it; integrate() looks at it
/// after every step.
inline std::atomic<int> interruption{0};
static_assert(std::atomic<int>::is_always_lock_free, "else a signal handler may not set it");

/// A signal ended a run between two steps. What was computed before it has been shown to the observers.
class Interrupted : public Error {
 public:
  Interrupted(int signal, const std::string& what) : Error(what), signal_(signal) {}
  int signal() const { return signal_; }

 private:
  int signal_;
};

}  // namespace hbvm
