#include "reference/closed_form/against_taylor.hpp"

namespace hbvm::core {
namespace {

constexpr const char* pendulum_name = "simple pendulum (Jacobi";

TEST(Pendulum, InThePlaneOfAnySizeSwingingOrTurning) {
  Fractions random(1);
  int swings = 0;
  for (const char* speed : {"0", "1/100", "1", "3", "20"})
    for (int n = 0; n < 3; ++n) {
      expect_follows_taylor(pendulum_scene(random, 2, speed, random.vector(2)), pendulum_name, {"1/3", "7"});
      ++swings;
    }
  EXPECT_EQ(swings, 15);
}

/// In units of 10^-3 and 10^6.
TEST(Pendulum, OfOtherUnits) {
  Fractions random(2);
  expect_follows_taylor(pendulum_scene(random, 2, "1/1000", "[\"1e-6\", \"-3e-6\"]"), pendulum_name, {"1000", "7000"});
  expect_follows_taylor(pendulum_scene(random, 2, "1000", "[\"2e6\", \"-1e6\"]"), pendulum_name, {"1/1000", "7/1000"});
}

/// Its velocity lies in the plane of the force and the rod, which stands anyhow in space.
std::string tilted(const char* position, const char* velocity, const char* gravity) {
  return std::string(
             "dimension = 3\n[constants]\na = \"3/5\"\nb = \"sqrt(7)/4\"\n[[point]]\nname = \"o\"\nposition = "
             "[1, -2, \"1/3\"]\n[[body]]\nname = \"bob\"\nmass = 3\nposition = ") +
         position + "\nvelocity = " + velocity +
         "\n[[constraint]]\nkind = \"rod\"\nbetween = [\"bob\", \"o\"]\nlength = \"sqrt(2)\"\n" +
         "[[effect]]\nkind = \"uniform_gravity\"\nacceleration = " + gravity + "\n";
}

TEST(Pendulum, InAnyPlaneOfSpace) {
  // The arm is sqrt(2) (a' cos x + b' sin x) in the plane of (1, 1, 0)/sqrt(2) and (0, 0, 1).
  expect_follows_taylor(tilted("[\"1 + a\", \"-2 + a\", \"1/3 + sqrt(2)*4/5\"]",
                               "[\"-4/5*b\", \"-4/5*b\", \"sqrt(2)*a*b\"]", "[0, 0, \"-9.81\"]"),
                        pendulum_name, {"1/3", "7"});
  expect_follows_taylor(tilted("[\"1 + a\", \"-2 + a\", \"1/3 + sqrt(2)*4/5\"]",
                               "[\"-4/5*b\", \"-4/5*b\", \"sqrt(2)*a*b\"]", "[\"1/7\", \"1/7\", \"5/3\"]"),
                        pendulum_name, {"1/3", "7"});
  // At the lowest point the velocity tells the plane.
  expect_follows_taylor(tilted("[1, -2, \"1/3 - sqrt(2)\"]", "[\"b\", \"2*a\", 0]", "[0, 0, -2]"), pendulum_name,
                        {"1/3", "7"});
  expect_follows_taylor(tilted("[1, -2, \"1/3 - sqrt(2)\"]", "[0, 0, 0]", "[0, 0, -2]"), pendulum_name, {"5"});
}

std::string plain(const char* position, const char* velocity, const char* gravity, const std::string& more = "",
                  const char* mass = "2") {
  return std::string("dimension = 2\n[[point]]\nname = \"o\"\nposition = [0, 0]\n[[body]]\nname = \"bob\"\nmass = ") +
         mass + "\nposition = " + position + "\nvelocity = " + velocity +
         "\n[[constraint]]\nkind = \"rod\"\nbetween = [\"o\", \"bob\"]\nlength = 1\n[[effect]]\nkind = "
         "\"uniform_gravity\"\nacceleration = " +
         gravity + "\n" + more;
}

TEST(Pendulum, AtRestBelowAndAboveAndOnTheSeparatrix) {
  expect_follows_taylor(plain("[0, -1]", "[0, 0]", "[0, -1]"), pendulum_name, {"1", "10"});
  expect_follows_taylor(plain("[0, 1]", "[0, 0]", "[0, -1]"), pendulum_name, {"1", "10"});
  // v^2/2 = 2 g at the bottom; errors grow by e^t.
  expect_follows_taylor(plain("[0, -1]", "[2, 0]", "[0, -1]"), pendulum_name, {"1", "10"}, 40, 10);
  // Beside it, by 10^-20, on either side: the time at the top is half as long as the digits allow.
  for (const char* speed : {"[\"2 - 1e-20\", 0]", "[\"2 + 1e-20\", 0]", "[\"-2 - 1e-20\", 0]"})
    expect_follows_taylor(plain("[0, -1]", speed, "[0, -1]"), pendulum_name, {"20", "60"}, 60, 30);
}

/// At rest above, exactly, for longer than rounding would leave it there; and beside it by less than any digit.
TEST(Pendulum, StaysAboveWhereItRests) {
  expect_follows_taylor(plain("[0, 1]", "[0, 0]", "[0, -1]"), pendulum_name, {"1000"}, 20);
  expect_follows_taylor(plain("[0, 1]", "[\"1e-200\", 0]", "[0, -1]"), pendulum_name, {"1", "10"}, 30, 14);
  expect_follows_taylor(plain("[0, -1]", "[\"1e-200\", 0]", "[0, -1]"), pendulum_name, {"1", "10"}, 30);
}

TEST(Pendulum, WithoutGravityIsACircle) {
  Fractions random(3);
  expect_follows_taylor(pendulum_scene(random, 2, "1", "[0, 0]"), "uniform circular motion", {"1", "9"});
  expect_follows_taylor(pendulum_scene(random, 3, "5", "[0, 0, 0]"), "uniform circular motion", {"1", "9"});
  expect_follows_taylor(pendulum_scene(random, 3, "0", "[0, 0, 0]"), "uniform circular motion", {"1", "9"});
  // Nearly none: it turns 10^15 times faster than it falls.
  expect_follows_taylor(plain("[0, -1]", "[1, 0]", "[0, \"-1e-30\"]"), pendulum_name, {"1", "10"}, 60);
}

TEST(Pendulum, OnACircleThatAQuadricIs) {
  const std::string circle =
      "dimension = 2\n[[body]]\nname = \"bead\"\nmass = [[3, 0], [0, 3]]\nposition = [2, 1]\nvelocity = [-1, "
      "1]\n[[constraint]]\nkind = \"quadric\"\nbody = \"bead\"\nA = [[2, 0], [0, 2]]\nb = [-4, 0]\nc = -2\n";
  // 2 (x - 1)^2 + 2 y^2 = 4.
  expect_follows_taylor(circle + "[[effect]]\nkind = \"uniform_gravity\"\nacceleration = [1, -2]\n", pendulum_name,
                        {"1", "10"});
  expect_unknown(
      "dimension = 2\n[[body]]\nname = \"bead\"\nmass = 3\nposition = [2, 0]\nvelocity = [0, "
      "1]\n[[constraint]]\nkind = \"quadric\"\nbody = \"bead\"\nA = [[2, 0], [0, 3]]\nb = [-4, 0]\nc = 0\n[[effect]]\n"
      "kind = \"uniform_gravity\"\nacceleration = [1, -2]\n");
}

TEST(Pendulum, NothingElseMayAct) {
  const std::string trap = "[[effect]]\nkind = \"trap\"\ncenter = \"o\"\nexponent = 2\nstiffness = ";
  expect_unknown(plain("[0, -1]", "[1, 0]", "[0, -1]", trap + "\"1e-30\"\n"));
  expect_follows_taylor(plain("[0, -1]", "[1, 0]", "[0, -1]", trap + "0\n"), pendulum_name, {"1"});
  // Two fields are one.
  expect_follows_taylor(
      plain("[0, -1]", "[1, 0]", "[0, -1]", "[[effect]]\nkind = \"uniform_gravity\"\nacceleration = [\"1/3\", 0]\n"),
      pendulum_name, {"1", "10"});
  // Masses that differ by direction, another body, and another constraint.
  expect_unknown(plain("[0, -1]", "[1, 0]", "[0, -1]", "", "[[2, 0], [0, 3]]"));
  expect_unknown(plain("[0, -1]", "[1, 0]", "[0, -1]",
                       "[[body]]\nname = \"other\"\nmass = 1\nposition = [5, 5]\nvelocity = [0, 0]\n"));
  expect_unknown(plain("[0, -1]", "[0, 0]", "[0, -1]",
                       "[[constraint]]\nkind = \"plane\"\nbody = \"bob\"\nnormal = [1, 0]\noffset = 0\n"));
}

TEST(Pendulum, HasAThousandDigits) {
  expect_solves_equations(plain("[0, -1]", "[1, 0]", "[0, -1]"), {"1/3", "10"}, 1000);
  expect_solves_equations(plain("[\"3/5\", \"4/5\"]", "[\"4\", \"-3\"]", "[\"1/7\", -1]"), {"10", "-5/2"}, 1000);
}

}  // namespace
}  // namespace hbvm::core
