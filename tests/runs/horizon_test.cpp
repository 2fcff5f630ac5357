#include "run/horizon.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "interrupting.hpp"
#include "printing.hpp"
#include "run/scene_run.hpp"
#include "step/registry.hpp"

namespace hbvm::core {
namespace {

RunRequest asked(const std::string& scene, const std::string& until) {
  return {load_scene(scene),        parse_method("hbvm:4,4"), SolverKind::automatic,
          Expression::parse("1/8"), Expression::parse(until), Precision::parse("double")};
}

TEST(HorizonTest, IsWhereAGrowthReachesTheDigits) {
  const std::vector<double> times{0, 1, 2, 3}, lost{0, 2, 4, 6};
  EXPECT_EQ(*horizon_of("a", 3, times, lost, 2).t, 2);
  EXPECT_FALSE(horizon_of("a", 3, times, lost, 2).extrapolated);
  const Horizon beyond = horizon_of("a", 10, times, lost, 2);
  EXPECT_EQ(*beyond.t, 5);
  EXPECT_TRUE(beyond.extrapolated);
  EXPECT_FALSE(horizon_of("a", 10, times, lost, 0).t);
}

/// What is foreseen in few digits is seen when the run is repeated with more, to a third.
TEST(HorizonTest, IsSeenByTheShadow) {
  RunRequest request = asked("chaotic_double_pendulum", "240");
  request.horizon = request.shadow = true;
  const hbvm::Run run = core::run(request, {});
  ASSERT_TRUE(run.health.horizon);
  const DigitsLost& horizon = *run.health.horizon;
  ASSERT_EQ(horizon.horizons.size(), 2u);
  EXPECT_EQ(horizon.horizons[0].precision, "double");
  ASSERT_TRUE(horizon.horizons[0].t && horizon.measured_t);
  EXPECT_NEAR(*horizon.measured_t, *horizon.horizons[0].t, *horizon.measured_t / 3);
  EXPECT_GT(*horizon.horizons[1].t, 1.5 * *horizon.horizons[0].t);
  for (std::size_t n = 1; n < horizon.lost.size(); ++n) EXPECT_GE(horizon.lost[n], horizon.lost[n - 1]);
  EXPECT_EQ(lost_by(horizon, -1), horizon.lost.front());
  EXPECT_EQ(lost_by(horizon, 1000), horizon.lost.back());
  const double middle = lost_by(horizon, (horizon.times[20] + horizon.times[21]) / 2);
  EXPECT_NEAR(middle, (horizon.lost[20] + horizon.lost[21]) / 2, 1e-9);
}

/// A regular motion loses digits as a power of the time: the rate of a short time is not that of a long one.
TEST(HorizonTest, IsNowhereForARegularMotion) {
  const DigitsLost growth = digits_lost(asked("simple_pendulum", "100"), {});
  for (const Horizon& horizon : growth.horizons) EXPECT_FALSE(horizon.t) << horizon.precision;
  EXPECT_LT(growth.lost.back(), 4);
}

TEST(HorizonTest, IsRefusedBackInTime) {
  RunRequest back = asked("simple_pendulum", "10");
  back.direction = Direction::backward;
  EXPECT_THROW(digits_lost(back, {}), InputError);
}

/// Where there is no series the reason is told, and the run is made.
TEST(HorizonTest, TellsWhyItIsNotKnown) {
  RunRequest request{read_scene("dimension = 1\nbody = [{ name = 'a', mass = 1, position = [1], velocity = [0] }]\n"
                                "effect = [{ kind = 'formula', U = '-abs(x)' }]\n",
                                "kink"),
                     parse_method("hbvm:2,2"),
                     SolverKind::automatic,
                     Expression::parse("1/8"),
                     Expression::parse("4"),
                     Precision::parse("double")};
  request.horizon = true;
  const hbvm::Run run = core::run(request, {});
  EXPECT_FALSE(run.health.horizon->failure.empty());
  EXPECT_EQ(run.t, "4");
}

}  // namespace
}  // namespace hbvm::core
