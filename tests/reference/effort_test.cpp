#include "reference/effort.hpp"

#include "printing.hpp"
#include "scene/assemble.hpp"

namespace hbvm::core {
namespace {

TEST(Effort, GrowsWithDigitsAndSteps) {
  const PrecisionScope scope(30);
  const Assembled<Mpfr> scene = assemble<Mpfr>(load_scene("tethered_satellites"));
  const MotionNature nature{1, -1, 50}, longer{1, -1, 5000};
  for (const auto effort : {effort_of_taylor, effort_of_hbvm, effort_of_proof}) {
    double seconds = 0, bytes = 0;
    for (const unsigned digits : {50u, 500u, 5000u}) {
      const Effort found = effort(scene.problem, nature, digits);
      EXPECT_GT(found.seconds, 3 * seconds) << found.route << " " << digits;
      EXPECT_GT(found.bytes, bytes) << found.route << " " << digits;
      EXPECT_GT(effort(scene.problem, longer, digits).seconds, 2 * found.seconds) << found.route << " " << digits;
      seconds = found.seconds;
      bytes = found.bytes;
    }
  }
  // HBVM has not the stages for thousands of digits.
  EXPECT_GT(effort_of_hbvm(scene.problem, nature, 5000).seconds, longest_effort);
}

TEST(Effort, OfAChainGrowsWithItsLengthAndNotWithItsCube) {
  const PrecisionScope scope(30);
  const MotionNature nature{1, -1, 50};
  const Assembled<Mpfr> ten = assemble<Mpfr>(load_scene("four_bars_10"));
  const Assembled<Mpfr> forty = assemble<Mpfr>(load_scene("four_bars_40"));
  const double ratio =
      effort_of_hbvm(forty.problem, nature, 50).seconds / effort_of_hbvm(ten.problem, nature, 50).seconds;
  EXPECT_GT(ratio, 3);
  EXPECT_LT(ratio, 6);
}

TEST(Effort, IsSaidInUnitsOfItsSize) {
  EXPECT_EQ(duration_text(1.5), "1.5 seconds");
  EXPECT_EQ(duration_text(300), "5 minutes");
  EXPECT_EQ(duration_text(9000), "2.5 hours");
  EXPECT_EQ(duration_text(5 * 86400), "5 days");
  EXPECT_EQ(duration_text(1e9), "31.7 years");
}

}  // namespace
}  // namespace hbvm::core
