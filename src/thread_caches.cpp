#include "thread_caches.hpp"

#include <flint/flint.h>
#include <mpfr.h>

namespace hbvm::core {

ThreadCaches::~ThreadCaches() {
  flint_cleanup();
  mpfr_free_cache();
}

}  // namespace hbvm::core
