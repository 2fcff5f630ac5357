#include <gtest/gtest.h>

#include "hbvm/results.hpp"
#include "words.hpp"

namespace hbvm {
namespace {

Comparison of(const std::string& csv) {
  return compare_results({.scene = load_scene("simple_pendulum"), .files = {{"theirs.csv", csv}}});
}

TEST(DoorResultsText, HasALineATimeAndTheLeastRight) {
  const std::string text = to_text(of("t,bob.x\n5,0\n1e1,0.114003850418645211312316725708\n"));
  core::expect_words(text, {"theirs.csv\n", "no row at t = 0", "least right", "computed now", "at the end: bob.x "});
}

TEST(DoorResultsText, SaysThatTheStartIsAnother) {
  core::expect_words(to_text(of("t,bob.x\n0,7\n5,0\n")), {"ITS START IS ANOTHER", "bob.x is 7, and "});
}

}  // namespace
}  // namespace hbvm
