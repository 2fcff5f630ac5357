#include "door/door.hpp"

#include <gtest/gtest.h>

#include <thread>

namespace hbvm::core {
namespace {

TEST(Admitted, AsksTheThreadsWorkToEndWhileItLives) {
  std::stop_source source;
  {
    const Admitted admitted(source.get_token());
    EXPECT_FALSE(stop_asked());
    source.request_stop();
    EXPECT_TRUE(stop_asked());
    EXPECT_THROW(watched({})(0.5), Interrupted);
    std::thread([] { EXPECT_FALSE(stop_asked()); }).join();
  }
  EXPECT_FALSE(stop_asked());
}

TEST(Admitted, ProgressIsToldOfTheParts) {
  double told = 0;
  watched([&](double part) { told = part; })(0.25);
  EXPECT_EQ(told, 0.25);
}

}  // namespace
}  // namespace hbvm::core
