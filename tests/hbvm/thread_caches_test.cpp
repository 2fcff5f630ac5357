#include "thread_caches.hpp"

#include <gtest/gtest.h>

#include <thread>

#include "scalar/precision.hpp"
#include "scalar/sine.hpp"

namespace hbvm::core {
namespace {

Mpfr sine_of_a_million() {
  const PrecisionScope digits(50);
  Mpfr r = 0;
  const Mpfr a = 1'000'000;
  set_sin(raw(r), raw(a), MPFR_RNDN);
  return r;
}

/// In a thread of its own and in this one: what was freed is computed again.
TEST(ThreadCaches, AreMadeAgainWhereTheyAreNeeded) {
  const Mpfr before = sine_of_a_million();
  std::thread([&] {
    for (int i = 0; i < 2; ++i) {
      const ThreadCaches freed;
      EXPECT_EQ(sine_of_a_million(), before);
    }
  }).join();
  { const ThreadCaches freed; }
  EXPECT_EQ(sine_of_a_million(), before);
}

}  // namespace
}  // namespace hbvm::core
