#include "audit/convergence.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "hard_cases/not_finite.hpp"

namespace hbvm::core {
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
    const Rate found = convergence_rate(ladder(8, power_law(rate))).value();
    // Sums of five products of small numbers.
    EXPECT_NEAR(found.value, rate, 64 * ulp * rate);
    EXPECT_LE(found.uncertainty, 256 * ulp * rate);
  }
}

TEST(ConvergenceRate, StepsNeedNotBeHalved) {
  std::vector<Rung> rungs;
  for (const double step : {0, -1, -4, -6, -7}) rungs.push_back({step, 5 + 3 * step, deep_floor});
  const Rate found = convergence_rate(rungs).value();
  EXPECT_NEAR(found.value, 3, 64 * ulp);
  EXPECT_EQ(found.halvings, 7);
}

TEST(ConvergenceRate, TellsHalvingsOfTheRungsUsed) {
  // Five of nine rungs are used.
  const Rate found = convergence_rate(ladder(9, power_law(6))).value();
  EXPECT_EQ(found.halvings, 4);
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
  const Rate found = convergence_rate(rungs).value();
  EXPECT_NEAR(found.value, 4, 64 * ulp);
  // The last that is used is 2^4 above the floor, which may be an eleventh of a power of two.
  EXPECT_GT(found.uncertainty, std::log2(1 + double{1} / 16));
  EXPECT_LT(found.uncertainty, double{1} / 2);
}

TEST(ConvergenceRate, RungsUnderTheFloorAreNotUsed) {
  std::vector<Rung> rungs = ladder(8, power_law(4));
  for (std::size_t n = 5; n < rungs.size(); ++n) rungs[n].floor = rungs[n].error + 1;
  rungs[7].error += 100;  // what is not used may be anything
  rungs[7].floor += 100;
  const Rate found = convergence_rate(rungs).value();
  EXPECT_NEAR(found.value, 4, 64 * ulp);
}

/// As an error that is exactly 0 for some step by chance, whatever the floor.
TEST(ConvergenceRate, ErrorsOfZeroAreNotClean) {
  EXPECT_FALSE((Rung{0, -infinity, deep_floor}.is_clean()));
  EXPECT_FALSE((Rung{0, -infinity, -infinity}.is_clean()));
  std::vector<Rung> rungs = ladder(6, power_law(4));
  rungs[3].error = -infinity;
  const Rate found = convergence_rate(rungs).value();
  EXPECT_NEAR(found.value, 4, 64 * ulp);
  EXPECT_EQ(found.halvings, 5);
  rungs[4].error = -infinity;
  EXPECT_FALSE(convergence_rate(rungs));
}

TEST(ConvergenceRate, ErrorsThatAreNoNumbersAreNotClean) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE((Rung{0, nan, deep_floor}.is_clean()));
  EXPECT_FALSE((Rung{0, -10, nan}.is_clean()));
}

/// With e = h^p (1 + a h^n) the rate is found to within what is said. That is not much more than the last slope is off
/// by.
TEST(ConvergenceRate, HigherTermsAreAllowedFor) {
  for (const double a : {double{1} / 4, double{1}, double{3}, -double{1} / 4})
    for (const int n : {1, 2}) {
      const auto error = [&](double step) { return 3 * step + std::log2(std::abs(1 + a * std::exp2(n * step))); };
      const Rate found = convergence_rate(ladder(8, error, 3)).value();
      EXPECT_LE(std::abs(found.value - 3), found.uncertainty) << a << " " << n;
      const double slope = error(-9) - error(-10);
      EXPECT_LT(found.uncertainty, (n == 1 ? 4 : 32) * std::abs(slope - 3)) << a << " " << n;
    }
}

/// Where rungs stand wider apart, a slope is nearer to the rate, but less than its finest step would have it.
TEST(ConvergenceRate, HigherTermsAreAllowedForWhereTheSpacingChanges) {
  for (const double a : {double{1} / 4, double{3}, double{100}})
    for (const int n : {1, 2})
      for (const int last : {1, 2, 3, 4}) {
        std::vector<Rung> rungs;
        for (int i = 0; i < 5; ++i) {
          const double step = -8 - i - (i >= 5 - last ? 3 * (i - 4 + last) : 0);
          rungs.push_back({step, 15 * step + std::log2(1 + a * std::exp2(n * step)), deep_floor});
        }
        const Rate found = convergence_rate(rungs).value();
        EXPECT_LE(std::abs(found.value - 15), found.uncertainty + 1'000 * ulp) << a << " " << n << " " << last;
      }
}

/// Where a term of lower order takes over, slopes change more and more: nothing is known of what they come to.
TEST(ConvergenceRate, ChangesThatGrowLeaveItOpen) {
  const Rate found =
      convergence_rate(ladder(
                           7, [](double step) { return std::log2(std::exp2(4 * step) + std::exp2(2 * step - 14)); }, 1))
          .value();
  EXPECT_EQ(found.uncertainty, infinity);
}

/// Four rungs further on it has taken over, and the finest rungs count, whatever those before them agree on.
TEST(ConvergenceRate, TheFinestRungsDecide) {
  const auto two_terms = [](double step) { return std::log2(std::exp2(4 * step) + std::exp2(2 * step - 14)); };
  const Rate found = convergence_rate(ladder(15, two_terms, 1)).value();
  EXPECT_NEAR(found.value, 2, double{1} / 100);
  EXPECT_LE(std::abs(found.value - 2), found.uncertainty);
}

/// Rungs near the floor say less than those before them, which they bear out.
TEST(ConvergenceRate, OfThoseThatAgreeTheBestCount) {
  std::vector<Rung> rungs = ladder(10, power_law(3), 0, -25);
  rungs.back().error += double{1} / 8;  // within what lies under the floor, which is 2^1 below
  const Rate found = convergence_rate(rungs).value();
  EXPECT_NEAR(found.value, 3, 64 * ulp);
  rungs.back().error += 2;  // not within it
  const Rate bent = convergence_rate(rungs).value();
  EXPECT_GT(bent.uncertainty, 1);
}

TEST(ConvergenceRate, UncertaintyReachesFromTheSlopeToItsLimit) {
  // Slopes 4, 4, 4, 8: the last difference of 4 may be followed by another (n = 1), or by a third of it.
  const Rate found = convergence_rate(ladder(5, [](double step) { return step == -4 ? -20 : 4 * step; })).value();
  EXPECT_NEAR(found.value, 8 + double{8} / 3, 64 * ulp);
  EXPECT_NEAR(found.uncertainty, 2 * 4, 64 * ulp);
}

TEST(ConvergenceRate, CoarseRungsBeforeTheAsymptoticRegimeDoNotMatter) {
  const auto wavy = [](double step) { return step > -4 ? 10 * std::sin(7 * step) : 4 * step; };
  const Rate found = convergence_rate(ladder(9, wavy)).value();
  EXPECT_NEAR(found.value, 4, 64 * ulp);
  EXPECT_LE(found.uncertainty, 256 * ulp);
}

/// Of 300'000 digits: what a double could not hold, its logarithm can.
TEST(ConvergenceRate, TinyErrorsAreErrors) {
  const double depth = 1'000'000;
  const Rate found = convergence_rate(ladder(
                                          6, [&](double step) { return 5 * step - depth; }, 0, -2 * depth))
                         .value();
  // Differences of numbers near 1e6, rounded there.
  EXPECT_NEAR(found.value, 5, 16 * ulp * depth);
  EXPECT_LE(found.uncertainty, 64 * ulp * depth);
}

TEST(ConvergenceRate, GrowingErrorsHaveNegativeRates) {
  const Rate found = convergence_rate(ladder(5, power_law(-1))).value();
  EXPECT_NEAR(found.value, -1, 64 * ulp);
}

}  // namespace
}  // namespace hbvm::core
