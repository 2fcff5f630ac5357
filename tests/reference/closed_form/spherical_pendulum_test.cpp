#include "reference/closed_form/against_taylor.hpp"

namespace hbvm::core {
namespace {

constexpr const char* spherical_name = "spherical pendulum";

TEST(SphericalPendulum, OfAnySizeAndDirection) {
  Fractions random(11);
  for (const char* speed : {"1/50", "1", "4", "30"})
    for (int n = 0; n < 3; ++n)
      expect_follows_taylor(pendulum_scene(random, 3, speed, random.vector(3)), spherical_name, {"1/3", "6"});
}

TEST(SphericalPendulum, OfOtherUnits) {
  Fractions random(12);
  expect_follows_taylor(pendulum_scene(random, 3, "1/1000", "[\"1e-6\", \"-3e-6\", \"2e-6\"]"), spherical_name,
                        {"1000", "5000"});
  expect_follows_taylor(pendulum_scene(random, 3, "1000", "[\"1e6\", \"-3e6\", \"2e6\"]"), spherical_name,
                        {"1/1000", "5/1000"});
}

std::string bob(const char* position, const char* velocity, const std::string& more = "") {
  return std::string(
             "dimension = 3\n[[point]]\nname = \"o\"\nposition = [0, 0, 0]\n[[body]]\nname = \"bob\"\nmass = "
             "2\nposition = ") +
         position + "\nvelocity = " + velocity +
         "\n[[constraint]]\nkind = \"rod\"\nbetween = [\"o\", \"bob\"]\nlength = 1\n[[effect]]\nkind = "
         "\"uniform_gravity\"\nacceleration = [0, 0, -1]\n" +
         more;
}

TEST(SphericalPendulum, TurnsRightForALongTime) {
  expect_follows_taylor(bob("[\"3/5\", 0, \"-4/5\"]", "[0, \"1/2\", 0]"), spherical_name, {"1000"}, 40, 11);
  expect_follows_taylor(bob("[\"2/3\", \"1/3\", \"-2/3\"]", "[\"-1/2\", 1, 0]"), spherical_name, {"1000"}, 40, 11);
}

/// The conical pendulum and its neighbours, where two roots are one or nearly so: below and above the equator
/// nothing changes.
TEST(SphericalPendulum, OnOrNearACone) {
  // omega^2 = g/0.8: v = 0.6 omega.
  for (const char* change : {"0", "1e-35", "1e-25", "-1e-12", "1e-5"})
    expect_follows_taylor(
        bob("[\"3/5\", 0, \"-4/5\"]", ("[0, \"3/5*sqrt(5/4) + (" + std::string(change) + ")\", 0]").c_str()),
        spherical_name, {"1/2", "20"});
}

/// Through the lowest point, or the highest, it would be a plane motion: by 10^-30 to 10^-3 beside that.
TEST(SphericalPendulum, NearAPlane) {
  for (const char* aside : {"1e-3", "1e-10", "1e-20", "1e-30"})
    for (const char* along : {"1/2", "3"})
      expect_follows_taylor(
          bob("[\"3/5\", 0, \"-4/5\"]",
              ("[\"" + std::string(along) + "*4/5\", \"" + aside + "\", \"" + along + "*3/5\"]").c_str()),
          spherical_name, {"1", "10"}, 50, 12);
}

/// So small a cone that the square of its radius is less than a digit, and the same beside the highest point.
TEST(SphericalPendulum, OnASmallCone) {
  for (const char* r : {"1e-5", "1e-18", "1e-60"})
    for (const char* side : {"-", ""}) {
      const std::string radius = r, height = side + ("sqrt(1 - " + radius + "^2)");
      expect_follows_taylor(
          bob(("[\"" + radius + "\", 0, \"" + height + "\"]").c_str(), ("[0, \"" + radius + "\", 0]").c_str()),
          spherical_name, {"1", "5"}, 30, 10);
    }
}

/// Beside the motion to the highest point that takes for ever, where two roots nearly coincide.
TEST(SphericalPendulum, NearTheSeparatrix) {
  for (const char* aside : {"1e-10", "1e-25", "1e-40"})
    expect_follows_taylor(bob("[\"3/5\", 0, \"-4/5\"]",
                              ("[\"4/5*sqrt(18/5)\", \"" + std::string(aside) + "\", \"3/5*sqrt(18/5)\"]").c_str()),
                          spherical_name, {"1", "10"}, 50, 16);
}

/// From a turning point, the equator, and upwards as well as downwards.
TEST(SphericalPendulum, FromSpecialStarts) {
  expect_follows_taylor(bob("[1, 0, 0]", "[0, \"1/3\", 0]"), spherical_name, {"1", "10"});
  expect_follows_taylor(bob("[1, 0, 0]", "[0, \"1/3\", 1]"), spherical_name, {"1", "10"});
  expect_follows_taylor(bob("[1, 0, 0]", "[0, \"-1/3\", -1]"), spherical_name, {"1", "10"});
  expect_follows_taylor(bob("[\"3/5\", 0, \"4/5\"]", "[0, 2, 0]"), spherical_name, {"1", "10"});
}

TEST(SphericalPendulum, NothingElseMayAct) {
  const std::string other = "[[effect]]\nkind = \"radial_cosine\"\ncenter = \"o\"\nstrength = \"1e-20\"\n";
  expect_unknown(bob("[\"3/5\", 0, \"-4/5\"]", "[0, 1, 0]", other));
  expect_unknown(bob("[\"3/5\", 0, \"-4/5\"]", "[0, 1, 0]",
                     "[[body]]\nname = \"b\"\nmass = 1\nposition = [3, 3, 3]\nvelocity = [0, 0, 0]\n"));
}

TEST(SphericalPendulum, HasAThousandDigits) {
  expect_solves_equations(bob("[\"2/3\", \"1/3\", \"-2/3\"]", "[\"-1/2\", 1, 0]"), {"10"}, 1000);
}

}  // namespace
}  // namespace hbvm::core
