#include "hbvm/analysis/audit/convergence.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "analysis/not_finite.hpp"

namespace hbvm {
namespace {

constexpr double ulp = std::numeric_limits<double>::epsilon();
/// Below every error here.
constexpr double deep_floor = -1'000;

/// Rungs at the steps 2^-first, 2^-(first + 1), … whose errors are a function of log2 h.
std::vector<Rung> ladder(int count, const std::function<double(double)>& error, int first = 0,
                         double floor = deep_floor) {
  std::vector<Rung> rungs;
  for (int n = 0; n < count; ++n) rungs.push_back({-double(first + n), error(-double(first + n)), floor});
  return rungs;
}
std::function<double(double)> power_law(double rate) {
  return [rate](double step) { return 3 + rate * step; };
}

TEST(ConvergenceRate, PowerLawGivesItsRate) {
  for (const int rate : {1, 2, 4, 7, 40}) {
    const auto found = convergence_rate(ladder(8, power_law(rate)));
    ASSERT_TRUE(found) << rate;
    // Sums of five products of small numbers.
    EXPECT_NEAR(found->value, rate, 16 * ulp * rate);
    EXPECT_LE(found->uncertainty, 64 * ulp * rate);
  }
}

TEST(ConvergenceRate, StepsNeedNotBeHalved) {
  std::vector<Rung> rungs;
  for (const double step : {0, -1, -4, -6, -7}) rungs.push_back({step, 5 + 3 * step, deep_floor});
  const auto found = convergence_rate(rungs);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->value, 3, 64 * ulp);
  EXPECT_EQ(found->halvings, 7);
}

TEST(ConvergenceRate, TellsHalvingsAndDecadesOfTheRungsUsed) {
  // Five of nine rungs are used.
  const auto found = convergence_rate(ladder(9, power_law(6)));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->halvings, 4);
  EXPECT_NEAR(found->decades, 24 * std::log10(2), 64 * ulp);
}

TEST(ConvergenceRate, NeedsFiveCleanRungs) {
  EXPECT_FALSE(convergence_rate({}));
  EXPECT_FALSE(convergence_rate(ladder(4, power_law(2))));
  EXPECT_TRUE(convergence_rate(ladder(5, power_law(2))));
  std::vector<Rung> rungs = ladder(5, power_law(2));
  rungs[2].floor = rungs[2].error;
  EXPECT_FALSE(convergence_rate(rungs));
}

TEST(ConvergenceRate, NeedsFourHalvings) {
  const auto of_steps = [](double between) {
    std::vector<Rung> rungs;
    for (int n = 0; n < 5; ++n) rungs.push_back({-between * n, -2 * between * n, deep_floor});
    return convergence_rate(rungs);
  };
  EXPECT_FALSE(of_steps(double{7} / 8));
  EXPECT_TRUE(of_steps(1));
}

TEST(ConvergenceRate, FloorIsNotClean) {
  EXPECT_FALSE((Rung{0, -50, -50}.is_clean()));
  EXPECT_FALSE((Rung{0, -51, -50}.is_clean()));
  EXPECT_TRUE((Rung{0, -49, -50}.is_clean()));
}

/// From the sixth rung on the errors stay at round-off.
TEST(ConvergenceRate, RungsAtTheFloorAreNotUsed) {
  std::vector<Rung> rungs = ladder(9, power_law(4), 0, -17);
  for (Rung& rung : rungs) rung.error = std::max(rung.error, rung.floor);
  const auto found = convergence_rate(rungs);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->value, 4, 64 * ulp);
  EXPECT_LE(found->uncertainty, 256 * ulp);
}

TEST(ConvergenceRate, RungsUnderTheFloorAreNotUsed) {
  std::vector<Rung> rungs = ladder(8, power_law(4));
  for (std::size_t n = 5; n < rungs.size(); ++n) rungs[n].floor = rungs[n].error + 1;
  rungs[7].error += 100;  // what is not used may be anything
  rungs[7].floor += 100;
  const auto found = convergence_rate(rungs);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->value, 4, 64 * ulp);
}

/// As an error that is exactly 0 for some step by chance, whatever the floor.
TEST(ConvergenceRate, ErrorsOfZeroAreNotClean) {
  EXPECT_FALSE((Rung{0, -infinity, deep_floor}.is_clean()));
  EXPECT_FALSE((Rung{0, -infinity, -infinity}.is_clean()));
  std::vector<Rung> rungs = ladder(6, power_law(4));
  rungs[3].error = -infinity;
  const auto found = convergence_rate(rungs);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->value, 4, 64 * ulp);
  EXPECT_EQ(found->halvings, 5);
  rungs[4].error = -infinity;
  EXPECT_FALSE(convergence_rate(rungs));
}

TEST(ConvergenceRate, ErrorsThatAreNoNumbersAreNotClean) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE((Rung{0, nan, deep_floor}.is_clean()));
  EXPECT_FALSE((Rung{0, -10, nan}.is_clean()));
}

/// Slope 2 where steps are coarse and 4 where they are fine: the truth may be either.
TEST(ConvergenceRate, BendIsUncertain) {
  const auto found = convergence_rate(ladder(5, [](double step) { return (step > -2 ? 2 : 4) * (step + 2); }));
  ASSERT_TRUE(found);
  EXPECT_GT(found->value, 2);
  EXPECT_LT(found->value, 4);
  EXPECT_GE(found->value + found->uncertainty, 4);
  EXPECT_GT(found->uncertainty, double{1} / 2);
}

/// Three slopes of 4 and a last one of 8: the line of 24/5 fits well, but the finest slope is the nearest to the truth.
TEST(ConvergenceRate, UncertaintyReachesToTheFinestSlope) {
  const auto found = convergence_rate(ladder(5, [](double step) { return step == -4 ? -20 : 4 * step; }));
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->value, double{24} / 5, 64 * ulp);
  EXPECT_NEAR(found->uncertainty, double{16} / 5, 64 * ulp);
}

/// Residuals that have no slope themselves, and none between the last two.
TEST(ConvergenceRate, ScatterGivesTheConfidenceInterval) {
  const double residuals[] = {2, -1, -3, 1, 1};
  std::vector<Rung> rungs = ladder(5, power_law(2));
  for (std::size_t n = 0; n < rungs.size(); ++n) rungs[n].error += residuals[n];
  const auto found = convergence_rate(rungs);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->value, 2, 64 * ulp);
  // The residuals' squares sum to 16, those of the steps about their mean to 10. Tables have the quantile to 3
  // decimals.
  const double student_t = 3.1824, decimals = 0.001;
  EXPECT_NEAR(found->uncertainty, student_t * std::sqrt(double{16} / 3 / 10), decimals);
}

TEST(ConvergenceRate, CoarseRungsBeforeTheAsymptoticRegimeDoNotMatter) {
  const auto wavy = [](double step) { return step > -4 ? 10 * std::sin(7 * step) : 4 * step; };
  const auto found = convergence_rate(ladder(9, wavy));
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->value, 4, 64 * ulp);
  EXPECT_LE(found->uncertainty, 256 * ulp);
}

/// Of 300'000 digits: what a double could not hold, its logarithm can.
TEST(ConvergenceRate, TinyErrorsAreErrors) {
  const double depth = 1'000'000;
  const auto found = convergence_rate(ladder(
      6, [&](double step) { return 5 * step - depth; }, 0, -2 * depth));
  ASSERT_TRUE(found);
  // Means of numbers near 1e6 are rounded there.
  EXPECT_NEAR(found->value, 5, 4 * ulp * depth);
  EXPECT_LE(found->uncertainty, 16 * ulp * depth);
}

TEST(ConvergenceRate, GrowingErrorsHaveNegativeRates) {
  const auto found = convergence_rate(ladder(5, power_law(-1)));
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->value, -1, 16 * ulp);
  EXPECT_LT(found->decades, 0);
}

}  // namespace
}  // namespace hbvm
