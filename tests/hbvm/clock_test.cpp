#include "clock.hpp"

#include <gtest/gtest.h>

#include <thread>

namespace hbvm::core {
namespace {

TEST(Clocks, GoForwardWithWork) {
  const double elapsed = elapsed_seconds(), worked = thread_seconds();
  while (thread_seconds() < worked + 1 / double{1000}) {
  }
  EXPECT_GE(elapsed_seconds() - elapsed, 1 / double{2000}) << "seconds, both";
}

TEST(Clocks, HaveADate) {
  const std::string day = today();
  ASSERT_EQ(day.size(), 10u);
  EXPECT_EQ(day.substr(0, 2), "20");
  EXPECT_EQ(day[4], '-');
  EXPECT_EQ(day[7], '-');
}

TEST(Clocks, OfAThreadCountNoOther) {
  const double before = thread_seconds();
  double others = 0;
  std::thread([&] {
    const double start = thread_seconds();
    while (thread_seconds() < start + 1 / double{50}) {
    }
    others = thread_seconds() - start;
  }).join();
  EXPECT_LT(thread_seconds() - before, others);
}

}  // namespace
}  // namespace hbvm::core
