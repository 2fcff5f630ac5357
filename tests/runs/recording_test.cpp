#include "run/recording.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "runs/request_of.hpp"
#include "scalar/precision.hpp"

namespace hbvm::core {
namespace {

TEST(Recording, HoldsEveryMeshPointOfAShortRun) {
  const Recording recording = recorded<double>(load_scene("double_pendulum"), "1/16", "2").first;
  EXPECT_EQ(recording.every, 1);
  ASSERT_EQ(recording.samples.size(), 33u);
  EXPECT_EQ(recording.samples[16].t, 1);
  EXPECT_EQ(recording.constraints.size(), 2u);
  EXPECT_EQ(recording.samples.front().lambda.size(), 2u);
  EXPECT_EQ(recording.samples.front().energy, -INFINITY);
}

/// 2500 steps and the last one, which is no multiple of 3: the greatest errors are among those kept all the same.
TEST(Recording, OfALongRunLeavesNoErrorOut) {
  const auto [recording, run] = recorded<double>(load_scene("double_pendulum"), "1/16", "156.25");
  EXPECT_EQ(recording.every, 3);
  EXPECT_EQ(recording.samples.size(), 1u + 833 + 1);
  EXPECT_LE(static_cast<long>(recording.samples.size()), Recording::most + 2);
  EXPECT_EQ(recording.samples.back().t, 156.25);
  double energy = -INFINITY, constraints = energy, hidden = energy;
  for (const Recording::Sample& sample : recording.samples) {
    energy = std::max(energy, sample.energy);
    constraints = std::max(constraints, sample.constraints);
    hidden = std::max(hidden, sample.hidden);
  }
  EXPECT_EQ(energy, std::log10(run.e_H));
  EXPECT_EQ(constraints, std::log10(run.e_g));
  EXPECT_EQ(hidden, std::log10(run.e_hid));
}

/// Between samples lambda goes up and down: the range has all of it.
TEST(Recording, OfALongRunHasTheRangeOfMultipliers) {
  const Recording all = recorded<double>(load_scene("double_pendulum"), "1/16", "50").first,
                  some = recorded<double>(load_scene("double_pendulum"), "1/16", "156.25").first;
  for (std::size_t n = 1; 3 * n < all.samples.size(); ++n) {
    double least = INFINITY, greatest = -INFINITY;
    for (std::size_t i = 3 * n - 2; i <= 3 * n; ++i) {
      least = std::min(least, all.samples[i].lambda[1]);
      greatest = std::max(greatest, all.samples[i].lambda[1]);
    }
    EXPECT_EQ(some.samples[n].least_lambda[1], least) << n;
    EXPECT_EQ(some.samples[n].greatest_lambda[1], greatest) << n;
  }
}

TEST(Recording, HasVelocitiesAndTheSizeOfRoundOff) {
  const Assembled<double> scene = assemble<double>(load_scene("double_pendulum"));
  const Recording recording = recorded<double>(load_scene("double_pendulum"), "1/16", "1").first;
  Vector<double> v(scene.q0.size());
  scene.problem.mass.velocity(lanes(scene.p0), lanes(v));
  EXPECT_EQ(recording.samples.front().v, std::vector<double>(v.begin(), v.end()));
  StateEvaluator<double> point(scene.problem);
  const double of_H = point.energy_size(scene.q0, scene.p0), of_g = point.constraint_size(scene.q0);
  EXPECT_EQ(recording.size_of_H, std::log10(of_H));
  EXPECT_EQ(recording.round_off, std::log10(epsilon<double>() * std::min(of_H, of_g)));
}

/// The last samples of a motion whose energy is lost for good are left out; a peak that passes is not.
TEST(Recording, IsSeenUntilItsEnergyIsLost) {
  Recording recording;
  recording.size_of_H = 1;
  for (const double energy : {-10, -9, 2, -9, 3, 4}) recording.samples.push_back({.energy = energy});
  EXPECT_EQ(recording.until_lost().samples.size(), 4u);
  recording.size_of_H = 5;
  EXPECT_EQ(recording.until_lost().samples.size(), 6u);
  recording.size_of_H = -INFINITY;
  EXPECT_EQ(recording.until_lost().samples.size(), 6u);
}

/// Errors of 10^-400 are none in double.
TEST(Recording, ShowsErrorsBeyondTheRangeOfDouble) {
  const PrecisionScope digits(420);
  const Recording recording = recorded<Mpfr>(load_scene("double_pendulum"), "1/16", "1/2").first;
  double greatest = -INFINITY;
  for (const Recording::Sample& sample : recording.samples) greatest = std::max(greatest, sample.constraints);
  EXPECT_LT(greatest, -410);
  EXPECT_GT(greatest, -430);
}

TEST(Recording, IsKeptWithItsRun) {
  const Assembled<double> scene = assemble<double>(load_scene("double_pendulum"));
  Recording first, second;
  MotionRecorder<double> one(scene.problem, 2, first), two(scene.problem, 2, second);
  one.observe({0, 0, scene.q0, scene.p0, Vector<double>::Zero(2)});
  one.observe({1, 0.5, scene.q0, 2 * scene.p0, Vector<double>::Ones(2)});
  Archive kept;
  one.remember(kept);
  Archive read(kept.text());
  two.remember(read);
  read.expect_end();
  ASSERT_EQ(second.samples.size(), 2u);
  EXPECT_EQ(second.samples[1].q, first.samples[1].q);
  EXPECT_EQ(second.samples[1].lambda, first.samples[1].lambda);
  EXPECT_EQ(second.samples[1].energy, first.samples[1].energy);
  EXPECT_EQ(second.samples[1].v, first.samples[1].v);
  EXPECT_EQ(second.round_off, first.round_off);
  one.observe({2, 1, scene.q0, 3 * scene.p0, Vector<double>::Ones(2)});
  two.observe({2, 1, scene.q0, 3 * scene.p0, Vector<double>::Ones(2)});
  EXPECT_EQ(second.samples[2].energy, first.samples[2].energy);
}

}  // namespace
}  // namespace hbvm::core
