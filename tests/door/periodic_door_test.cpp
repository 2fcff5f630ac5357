#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "hbvm/error.hpp"
#include "hbvm/periodic.hpp"
#include "words.hpp"

namespace hbvm {
namespace {

TEST(DoorPeriodic, TellsStartPeriodAndMultipliers) {
  PeriodicRequest request{.scene = load_scene("henon_heiles"), .until = 8};
  double done = 0;
  request.progress = [&](double part) { done = part; };
  const Periodic found = periodic(request);
  EXPECT_EQ(done, 1);
  EXPECT_EQ(found.q[0], "0");
  EXPECT_EQ(found.H, "0.125000000000000000000000000000");
  EXPECT_TRUE(found.stable);
  core::expect_words(to_text(found), {"T = 6.07561578432290161291645547481", "two routes agree in", "multipliers"});
  const auto json = nlohmann::json::parse(to_json(found));
  EXPECT_EQ(json.at("q").size(), 2u);
  EXPECT_EQ(json.at("multipliers").size(), 4u);
  EXPECT_EQ(json.at("command"), "hbvm periodic henon_heiles --until '8' --digits 30");
}

/// What vanishes has no digits: at the turning point of a brake orbit, all momenta.
TEST(DoorPeriodic, PrintsNoDigitsOfRounding) {
  const Periodic found = periodic({.scene = load_scene("chaotic_double_pendulum"), .until = 12});
  for (const std::string& p : found.p) EXPECT_EQ(p, "0");
  EXPECT_EQ(found.H, "0");
}

TEST(DoorPeriodic, IsRefused) {
  PeriodicRequest request{.scene = load_scene("henon_heiles"), .until = 8};
  request.digits = 0;
  EXPECT_THROW(periodic(request), InputError);
  request.digits = 30;
  request.plane = "nobody.x";
  EXPECT_THROW(periodic(request), InputError);
  request.plane = "star.x +";
  EXPECT_THROW(periodic(request), InputError);
}

}  // namespace
}  // namespace hbvm
