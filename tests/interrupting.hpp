#pragma once

#include <atomic>

#include "interruption.hpp"

namespace hbvm::core {

/// A signal that tests send: its number, or 0. It asks the main thread's work to end.
inline std::atomic<int> interruption{0};
inline const StopRequest asked_by_test{{}, &interruption};
inline const bool main_thread_is_asked = (stop_request = &asked_by_test, true);

}  // namespace hbvm::core
