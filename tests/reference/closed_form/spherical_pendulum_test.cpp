#include <fmt/format.h>

#include "reference/closed_form/against_taylor.hpp"
#include "reference/closed_form/recognition.hpp"
#include "scalar/literal.hpp"

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

std::string bob(const std::string& position, const std::string& velocity, const std::string& more = "") {
  return "dimension = 3\n" + point("o", "[0, 0, 0]") + body("bob", "2", position, velocity) + rod("o", "bob", "1") +
         field("[0, 0, -1]") + more;
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
    expect_follows_taylor(bob("[\"3/5\", 0, \"-4/5\"]", fmt::format("[0, \"3/5*sqrt(5/4) + ({})\", 0]", change)),
                          spherical_name, {"1/2", "20"});
}

/// Through the lowest point, or the highest, it would be a plane motion: by 10^-30 to 10^-3 beside that.
TEST(SphericalPendulum, NearAPlane) {
  for (const char* aside : {"1e-3", "1e-10", "1e-20", "1e-30"})
    for (const char* along : {"1/2", "3"})
      expect_follows_taylor(
          bob("[\"3/5\", 0, \"-4/5\"]", fmt::format("[\"{0}*4/5\", \"{1}\", \"{0}*3/5\"]", along, aside)),
          spherical_name, {"1", "10"}, 50, 12);
}

/// A velocity across the plane of 1000 units of rounding is one; of a few it is none.
TEST(SphericalPendulum, LeavesAPlaneByMoreThanRounding) {
  const PrecisionScope scope(60);
  for (const auto& [units, plane] : {std::pair("1000", false), {"1", true}, {"0", true}}) {
    const Assembled<Mpfr> scene = assemble<Mpfr>(
        read_scene(bob("[\"9/25\", \"12/25\", \"-4/5\"]",
                       fmt::format("[\"12/25 - {0}e-60*4/5\", \"16/25 + {0}e-60*3/5\", \"3/5\"]", units)),
                   "nearly plane"));
    const Recognition content(scene, literal<Mpfr>("1e-60"));
    const std::optional<OnSphere> sphere = content.on_sphere();
    ASSERT_TRUE(sphere);
    EXPECT_EQ(plane_of_motion(content, *sphere, -Vector<Mpfr>::Unit(3, 2)).has_value(), plane) << units;
  }
}

/// So small a cone that the square of its radius is less than a digit, and the same beside the highest point.
TEST(SphericalPendulum, OnASmallCone) {
  for (const char* r : {"1e-5", "1e-18", "1e-60"})
    for (const char* side : {"-", ""})
      expect_follows_taylor(
          bob(fmt::format("[\"{0}\", 0, \"{1}sqrt(1 - {0}^2)\"]", r, side), fmt::format("[0, \"{}\", 0]", r)),
          spherical_name, {"1", "5"}, 30, 10);
}

/// Beside the motion to the highest point that takes for ever, where two roots nearly coincide.
TEST(SphericalPendulum, NearTheSeparatrix) {
  for (const char* aside : {"1e-10", "1e-25", "1e-40"})
    expect_follows_taylor(
        bob("[\"3/5\", 0, \"-4/5\"]", fmt::format("[\"4/5*sqrt(18/5)\", \"{}\", \"3/5*sqrt(18/5)\"]", aside)),
        spherical_name, {"1", "10"}, 50, 16);
}

/// From a turning point, the equator, and upwards as well as downwards.
TEST(SphericalPendulum, FromSpecialStarts) {
  for (const char* velocity : {"[0, \"1/3\", 0]", "[0, \"1/3\", 1]", "[0, \"-1/3\", -1]"})
    expect_follows_taylor(bob("[1, 0, 0]", velocity), spherical_name, {"1", "10"});
  expect_follows_taylor(bob("[\"3/5\", 0, \"4/5\"]", "[0, 2, 0]"), spherical_name, {"1", "10"});
}

TEST(SphericalPendulum, NothingElseMayAct) {
  for (const std::string& other :
       {effect("radial_cosine", "center = \"o\"\nstrength = \"1e-20\""), body("b", "1", "[3, 3, 3]", "[0, 0, 0]")})
    expect_unknown(bob("[\"3/5\", 0, \"-4/5\"]", "[0, 1, 0]", other));
}

TEST(SphericalPendulum, HasAThousandDigits) {
  expect_solves_equations(bob("[\"2/3\", \"1/3\", \"-2/3\"]", "[\"-1/2\", 1, 0]"), {"10"}, 1000);
}

}  // namespace
}  // namespace hbvm::core
