#pragma once

namespace hbvm::core {

/// Where one ends, what MPFR and FLINT keep for its thread is freed, such as pi in many digits. It stands first in the
/// work of a thread; what is needed later is computed again.
class ThreadCaches {
 public:
  ThreadCaches() = default;
  ~ThreadCaches();
  ThreadCaches(const ThreadCaches&) = delete;
};

}  // namespace hbvm::core
