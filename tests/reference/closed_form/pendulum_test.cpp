#include "reference/closed_form/against_taylor.hpp"

namespace hbvm::core {
namespace {

constexpr const char* pendulum_name = "simple pendulum (Jacobi";

TEST(Pendulum, InThePlaneOfAnySizeSwingingOrTurning) {
  Fractions random(1);
  for (const char* speed : {"0", "1/100", "1", "3", "20"})
    for (int n = 0; n < 3; ++n)
      expect_follows_taylor(pendulum_scene(random, 2, speed, random.vector(2)), pendulum_name, {"1/3", "7"});
}

/// In units of 10^-3 and 10^6.
TEST(Pendulum, OfOtherUnits) {
  Fractions random(2);
  expect_follows_taylor(pendulum_scene(random, 2, "1/1000", "[\"1e-6\", \"-3e-6\"]"), pendulum_name, {"1000", "7000"});
  expect_follows_taylor(pendulum_scene(random, 2, "1000", "[\"2e6\", \"-1e6\"]"), pendulum_name, {"1/1000", "7/1000"});
}

/// Its velocity lies in the plane of the force and the rod, which stands anyhow in space.
std::string tilted(const char* position, const char* velocity, const char* gravity) {
  return "dimension = 3\n[constants]\na = \"3/5\"\nb = \"sqrt(7)/4\"\n" + point("o", "[1, -2, \"1/3\"]") +
         body("bob", "3", position, velocity) + rod("bob", "o", "\"sqrt(2)\"") + field(gravity);
}

TEST(Pendulum, InAnyPlaneOfSpace) {
  // The arm is sqrt(2) (a' cos x + b' sin x) in the plane of (1, 1, 0)/sqrt(2) and (0, 0, 1).
  for (const char* gravity : {"[0, 0, \"-9.81\"]", "[\"1/7\", \"1/7\", \"5/3\"]"})
    expect_follows_taylor(
        tilted("[\"1 + a\", \"-2 + a\", \"1/3 + sqrt(2)*4/5\"]", "[\"-4/5*b\", \"-4/5*b\", \"sqrt(2)*a*b\"]", gravity),
        pendulum_name, {"1/3", "7"});
  // At the lowest point the velocity tells the plane.
  expect_follows_taylor(tilted("[1, -2, \"1/3 - sqrt(2)\"]", "[\"b\", \"2*a\", 0]", "[0, 0, -2]"), pendulum_name,
                        {"1/3", "7"});
  expect_follows_taylor(tilted("[1, -2, \"1/3 - sqrt(2)\"]", "[0, 0, 0]", "[0, 0, -2]"), pendulum_name, {"5"});
}

std::string plain(const char* position, const char* velocity, const char* gravity, const std::string& more = "",
                  const char* mass = "2") {
  return "dimension = 2\n" + point("o", "[0, 0]") + body("bob", mass, position, velocity) + rod("o", "bob", "1") +
         field(gravity) + more;
}

TEST(Pendulum, AtRestBelowAndAboveAndOnTheSeparatrix) {
  for (const char* position : {"[0, -1]", "[0, 1]"})
    expect_follows_taylor(plain(position, "[0, 0]", "[0, -1]"), pendulum_name, {"1", "10"});
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
  // 2 (x - 1)^2 + 2 y^2 = 4.
  const std::string circle = body("bead", "[[3, 0], [0, 3]]", "[2, 1]", "[-1, 1]") +
                             quadric("bead", "[[2, 0], [0, 2]]", "[-4, 0]", "-2"),
                    ellipse =
                        body("bead", "3", "[2, 0]", "[0, 1]") + quadric("bead", "[[2, 0], [0, 3]]", "[-4, 0]", "0");
  expect_follows_taylor("dimension = 2\n" + circle + field("[1, -2]"), pendulum_name, {"1", "10"});
  expect_unknown("dimension = 2\n" + ellipse + field("[1, -2]"));
}

TEST(Pendulum, NothingElseMayAct) {
  const auto trap = [](const std::string& stiffness) {
    return effect("trap", "center = \"o\"\nexponent = 2\nstiffness = " + stiffness);
  };
  expect_unknown(plain("[0, -1]", "[1, 0]", "[0, -1]", trap("\"1e-30\"")));
  expect_follows_taylor(plain("[0, -1]", "[1, 0]", "[0, -1]", trap("0")), pendulum_name, {"1"});
  // Two fields are one.
  expect_follows_taylor(plain("[0, -1]", "[1, 0]", "[0, -1]", field("[\"1/3\", 0]")), pendulum_name, {"1", "10"});
  // Masses that differ by direction, another body, and another constraint.
  expect_unknown(plain("[0, -1]", "[1, 0]", "[0, -1]", "", "[[2, 0], [0, 3]]"));
  expect_unknown(plain("[0, -1]", "[1, 0]", "[0, -1]", body("other", "1", "[5, 5]", "[0, 0]")));
  expect_unknown(plain("[0, -1]", "[0, 0]", "[0, -1]", plane("bob", "[1, 0]", "0")));
}

TEST(Pendulum, HasAThousandDigits) {
  expect_solves_equations(plain("[0, -1]", "[1, 0]", "[0, -1]"), {"1/3", "10"}, 1000);
  expect_solves_equations(plain("[\"3/5\", \"4/5\"]", "[\"4\", \"-3\"]", "[\"1/7\", -1]"), {"10", "-5/2"}, 1000);
}

}  // namespace
}  // namespace hbvm::core
