#include "hard_cases/round_off_growth.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "hard_cases/line_fit.hpp"
#include "hard_cases/measure.hpp"

namespace hbvm::core {
namespace {

double exponent(const Straying& straying) {
  std::vector<double> x, y;
  for (const auto& point : straying.points()) {
    if (point.steps < 64) continue;
    x.push_back(std::log2(static_cast<double>(point.steps)));
    y.push_back(std::log2(point.distance));
  }
  return fit_line(x, y).slope;
}

TEST(Straying, OfARandomWalkIsTheRootOfTimeThatOfADriftIsTime) {
  constexpr long steps = 1L << 17;
  Straying walk, drift, both;
  unsigned state = 1;
  double x = 0;
  for (long n = 0; n <= steps; ++n) {
    walk.add(x);
    drift.add(static_cast<double>(n) / 1000);
    both.add(x + static_cast<double>(n) / 10);
    state = state * 1'664'525u + 1'013'904'223u;
    x += state >> 31 ? 1 : -1;
  }
  EXPECT_NEAR(exponent(walk), 0.5, 0.06);
  EXPECT_NEAR(exponent(drift), 1, 1e-9);
  EXPECT_GT(exponent(both), 0.7);
  EXPECT_EQ(walk.points().size(), 18u);
  EXPECT_EQ(walk.points().front().distance, 1);
  EXPECT_NEAR(drift.points().back().distance, steps / 1000., 1e-9);
}

TEST(RoundOffGrowth, OfAMethodThatLosesEnergyIsNotThatOfRoundOff) {
  const auto request = [](const char* method, const char* until) {
    return request_of(load_scene("kepler"), method, "paper", "1/32", until, "double");
  };
  const CaseResult lost = long_run(request("hbvm:3,3", "64"));
  ASSERT_EQ(lost.criteria.size(), 2u);
  EXPECT_FALSE(lost.criteria[1].holds()) << "k = s does not conserve the energy of Kepler's problem";
  const CaseResult kept = long_run(request("hbvm:12,4", "64"));
  EXPECT_TRUE(kept.criteria[1].holds()) << kept.criteria[1].value << " of " << kept.criteria[1].bound;
  EXPECT_TRUE(kept.criteria[0].holds()) << kept.criteria[0].value;
}

TEST(RoundOffGrowth, MeasuresConstraintsToo) {
  const CaseResult result =
      long_run(request_of(load_scene("simple_pendulum"), "hbvm:1,1", "paper", "1/32", "64", "quad"));
  ASSERT_EQ(result.criteria.size(), 4u);
  for (const Criterion& c : result.criteria) EXPECT_GE(c.value, 0) << c.what;
  EXPECT_EQ(result.criteria[3].what, "e_g, units of round-off");
}

}  // namespace
}  // namespace hbvm::core
