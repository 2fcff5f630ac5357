#include "compare/compare_methods.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "runs/request_of.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

std::vector<RecordedMethod> runs_of(const RunRequest& request, const std::vector<const char*>& names) {
  return run_methods(request, named_methods({names.begin(), names.end()}), {});
}

/// Each has the numbers of a run by itself.
TEST(CompareMethods, RunsEachAsByItself) {
  const RunRequest request = request_of(load_scene("double_pendulum"), "rattle", "1/64", "1");
  const std::vector<RecordedMethod> runs = runs_of(request, {"hbvm:4,2", "rattle", "rk4"});
  ASSERT_EQ(runs.size(), 3u);
  EXPECT_EQ(runs[0].figures.method, "hbvm:4,2");
  EXPECT_LT(std::stod(runs[0].figures.e_H), 1e-14);
  EXPECT_GT(std::stod(runs[1].figures.e_H), 1e-6);
  EXPECT_LT(std::stod(runs[1].figures.e_hid), 1e-13);
  EXPECT_GT(std::stod(runs[2].figures.e_g), 1e-12);
  for (const RecordedMethod& run : runs) {
    EXPECT_EQ(run.figures.failure, "");
    EXPECT_EQ(run.recording.samples.size(), 65u);
    EXPECT_EQ(run.q.size(), 4u);
  }
  EXPECT_EQ(runs_of(request, {"rattle"})[0].q, runs[1].q);
}

/// The digits of an exact motion: Kepler's after a whole period is where it began.
TEST(CompareMethods, CountsTheDigitsOfTheEnd) {
  const RunRequest request = request_of(load_scene("kepler"), "rattle", "2*pi/256", "2*pi");
  std::vector<RecordedMethod> runs = runs_of(request, {"rattle", "gauss:3", "gauss:8"});
  EXPECT_EQ(count_digits(request, runs), "");
  for (const RecordedMethod& run : runs) {
    const double x = std::stod(run.q[0]) - 0.5, y = std::stod(run.q[1]);
    const double digits = -std::log10(std::max(std::abs(x), std::abs(y)) / 0.5);
    EXPECT_NEAR(*run.figures.digits, digits, 0.01 + (digits > 13 ? 1 : 0)) << run.figures.method;
  }
  EXPECT_LT(*runs[0].figures.digits, 4);
  EXPECT_GT(*runs[2].figures.digits, 12);
  EXPECT_LE(*runs[2].figures.digits, 16);
}

/// A run that fails is told as such, and ends no other: a pendulum by so long a step, and a fall into the centre.
TEST(CompareMethods, TellsOfOneThatFails) {
  const RunRequest request = request_of(load_scene("double_pendulum"), "rattle", "2", "40");
  std::vector<RecordedMethod> runs = runs_of(request, {"rattle", "rk4"});
  EXPECT_NE(runs[0].figures.failure, "");
  EXPECT_EQ(runs[0].figures.e_H, "");
  count_digits(request, runs);
  EXPECT_FALSE(runs[0].figures.digits);
}

TEST(CompareMethods, SaysWhyThereAreNoDigits) {
  const Scene falling = read_scene(
      "dimension = 2\npoint = [{ name = \"o\", position = [0, 0] }]\nbody = [{ name = \"a\", mass = 1, "
      "position = [1, 0], velocity = [0, 0] }]\n"
      "effect = [{ kind = \"central_gravity\", center = \"o\", strength = 1 }]\n",
      "falling");
  const RunRequest request = request_of(falling, "rattle", "1/4", "4");
  std::vector<RecordedMethod> runs = runs_of(request, {"rattle", "rk4"});
  EXPECT_NE(count_digits(request, runs), "");
  for (const RecordedMethod& run : runs) EXPECT_FALSE(run.figures.digits);
}

TEST(CompareMethods, CountsTheStepsOfAll) {
  const RunRequest request = request_of(load_scene("kepler"), "rattle", "1/16", "1");
  long last = 0, all = 0;
  run_methods(request, named_methods({"rattle", "rk4"}), [&](long done, long of) {
    EXPECT_GE(done, last);
    last = done;
    all = of;
  });
  EXPECT_EQ(all, 32);
  EXPECT_EQ(last, 32);
}

}  // namespace
}  // namespace hbvm::core
