#pragma once

#include <future>

namespace hbvm::core {

/// How std::async runs what may run beside other work: in a thread of its own. Where there are no threads, as in a
/// browser's worker, it runs when its result is asked for.
#ifdef __EMSCRIPTEN__
inline constexpr auto beside = std::launch::deferred;
#else
inline constexpr auto beside = std::launch::async;
#endif

}  // namespace hbvm::core
