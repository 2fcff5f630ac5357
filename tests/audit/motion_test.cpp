#include "audit/motion.hpp"

#include <gtest/gtest.h>

#include "folder.hpp"

namespace hbvm::core {
namespace {

class MotionTest : public ::testing::Test {
 protected:
  Motion of(const std::string& text) const {
    return motion_of(
        folder_.write("scene.toml", "dimension = 2\npoint = [{ name = \"o\", position = [0, 0] }]\n" + text));
  }
  static std::string body(const std::string& position, const std::string& velocity) {
    return "[[body]]\nname = \"a\"\nmass = 1\nposition = " + position + "\nvelocity = " + velocity + "\n";
  }
  static std::string spring(const std::string& stiffness) {
    return "[[effect]]\nkind = \"trap\"\ncenter = \"o\"\nstiffness = \"" + stiffness + "\"\nexponent = 2\n";
  }

 private:
  Folder folder_;
};

/// 4/omega, or the power of two below that resolves it.
TEST_F(MotionTest, ScaleIsThatOfTheFastestSpring) {
  const int unit = of(body("[1, 0]", "[0, \"1/2\"]") + spring("1")).log2_scale;
  EXPECT_GE(unit, 0);
  EXPECT_LE(unit, 2);
  for (const int bits : {20, -20, 60}) {
    const std::string stiffness = "2^(" + std::to_string(2 * bits) + ")";
    EXPECT_EQ(of(body("[1, 0]", "[0, \"1/2*2^(" + std::to_string(bits) + ")\"]") + spring(stiffness)).log2_scale,
              unit - bits)
        << bits;
  }
}

/// The constraint makes it fast, not a force: a rod that turns a million times in a unit of time.
TEST_F(MotionTest, ScaleIsThatOfTheFastestRod) {
  const std::string rod = "[[constraint]]\nkind = \"rod\"\nbetween = [\"o\", \"a\"]\nlength = 1\n";
  const auto scale = [&](const std::string& speed) {
    return of(body("[1, 0]", "[0, \"" + speed + "\"]") + rod).log2_scale;
  };
  EXPECT_EQ(scale("2^20"), scale("1") - 20);
}

TEST_F(MotionTest, ScalesDoNotDependOnUnits) {
  const int unit = motion_of("kepler").log2_scale;
  EXPECT_EQ(
      of(body("[\"2/5*10^11\", 0]", "[0, \"2*10^11/2^30\"]") +
         "[[effect]]\nkind = \"central_gravity\"\ncenter = \"o\"\nstrength = \"10^33/2^60\"\n")
          .log2_scale,
      of(body("[\"2/5\", 0]", "[0, 2]") + "[[effect]]\nkind = \"central_gravity\"\ncenter = \"o\"\nstrength = 1\n")
              .log2_scale +
          30);
  EXPECT_GE(unit, -2);
  EXPECT_LE(unit, 2);
}

TEST_F(MotionTest, RestAndUniformMotionSayNothing) {
  EXPECT_EQ(of(body("[0, 0]", "[0, 0]") + spring("1")).degenerate, "nothing moves");
  const Motion uniform = of(body("[1, 0]", "[\"1/3\", 1]"));
  EXPECT_EQ(uniform.degenerate, "no force accelerates anything");
  EXPECT_TRUE(uniform.straight);
}

/// A spring along a rod, ten orders of magnitude stronger than what turns the rod.
TEST_F(MotionTest, ForcesThatBalanceLeaveTheMotionThatThereIs) {
  const std::string pair =
      "body = [{ name = \"a\", mass = 1, position = [1, 0], velocity = [0, 1] }, { name = \"b\", mass = 2, position = "
      "[1, \"1/2\"], velocity = [\"-1/3\", 1] }]\nconstraint = [{ kind = \"rod\", between = [\"a\", \"b\"], length = "
      "\"1/2\" }, { kind = \"rod\", between = [\"o\", \"a\"], length = 1 }]\n[[effect]]\nkind = \"uniform_gravity\"\n"
      "acceleration = [0, -1]\n[[effect]]\nkind = \"spring\"\nbetween = [\"a\", \"b\"]\nstiffness = "
      "\"10^10\"\nrest_length = "
      "3\n";
  EXPECT_EQ(of(pair).degenerate, "");
}

/// On a circle all terms keep their sizes; on an ellipse not, and on a line there is no angular momentum to try.
TEST_F(MotionTest, RelativeEquilibriaAreSeen) {
  const Motion circle = of(body("[1, 0]", "[0, 1]") + spring("1"));
  EXPECT_NE(circle.degenerate.find("relative equilibrium"), std::string::npos);
  EXPECT_FALSE(circle.straight);
  EXPECT_EQ(of(body("[1, 0]", "[0, \"1/2\"]") + spring("1")).degenerate, "");
  const Motion line = of(body("[1, \"1/2\"]", "[\"1/5\", \"1/10\"]") + spring("1"));
  EXPECT_EQ(line.degenerate, "");
  EXPECT_TRUE(line.straight);
  EXPECT_NE(motion_of("conical_pendulum").degenerate, "");
  for (const char* const scene : {"kepler", "double_pendulum", "heavy_top", "tethered_satellites"})
    EXPECT_EQ(motion_of(scene).degenerate, "") << scene;
}

/// Two bodies that circle about one another while both drift away.
TEST_F(MotionTest, ACommonMotionHidesNoEquilibrium) {
  const Motion motion =
      of("body = [{ name = \"a\", mass = 1, position = [1, 0], velocity = [3, \"1+1/2\"] }, { name = \"b\", mass = 1, "
         "position "
         "= [-1, 0], velocity = [3, \"1-1/2\"] }]\neffect = [{ kind = \"mutual_gravity\", strength = 1 }]\n");
  EXPECT_NE(motion.degenerate.find("relative equilibrium"), std::string::npos);
}

}  // namespace
}  // namespace hbvm::core
