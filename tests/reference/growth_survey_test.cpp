#include "reference/growth_survey.hpp"

#include <cmath>

#include "printing.hpp"
#include "reference/scene_tables.hpp"

namespace hbvm::core {
namespace {

GrowthSurvey survey(const Scene& scene, const char* until) {
  return survey_growth(scene, Expression::parse(until), [](double) {});
}

/// An oscillator's errors do not grow, measured by its rate, here 2^3; in other units of time the rate is as much less.
TEST(GrowthSurvey, FindsTheRateOfAnOscillator) {
  const std::string start = "dimension = 2\n" + body("a", "1", "[1, 0]", "[0, 0]");
  const GrowthSurvey fast = survey(read_scene(start + formula("-32*(x^2 + y^2)"), "fast"), "20");
  EXPECT_LT(fast.growth, 1e-9);
  EXPECT_EQ(fast.omega_at(0), 8);
  EXPECT_EQ(fast.omega_at(20), 8);
  EXPECT_GT(fast.steps, 20);
  const GrowthSurvey slow = survey(read_scene(start + formula("-32*(x^2 + y^2)/1024^2"), "slow"), "20*1024");
  EXPECT_EQ(slow.omega_at(100), 8.0 / 1024);
}

/// A stiff wall is felt for a short time, and there the rate is another. Errors grow by some powers of ten, where one
/// rate for all of the time would let them grow by thousands.
TEST(GrowthSurvey, ChangesTheRateWhereAStiffForceActs) {
  const Scene wall =
      read_scene("dimension = 2\n" + body("a", "1", "[1, 0]", "[-1, 0]") + formula("-exp(-1000*x)"), "wall");
  const GrowthSurvey found = survey(wall, "2");
  EXPECT_LT(found.growth, 12);
  EXPECT_GT(found.growth, 1);
  EXPECT_GT(found.omega_at(1.001), 64 * found.omega_at(0.1));
}

}  // namespace
}  // namespace hbvm::core
