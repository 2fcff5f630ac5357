#include "reference/usual_step.hpp"

#include <gtest/gtest.h>

#include "hbvm/error.hpp"
#include "printing.hpp"
#include "scalar/literal.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

std::string step_of(const std::string& scene, const std::string& until) {
  return usual_step(load_scene(scene), Expression::parse(until)).text();
}

/// Two bodies of a mass that attract one another, a unit of length apart; the motion is as slow as the mass is small.
Scene pair(const std::string& mass) {
  return read_scene("dimension = 2\n[constants]\nG = \"" + mass +
                        "\"\n"
                        "[[point]]\nname = \"sun\"\nposition = [0, 0]\n"
                        "[[body]]\nname = \"planet\"\nmass = 1\nposition = [1, 0]\nvelocity = [0, \"sqrt(G)\"]\n"
                        "[[effect]]\nkind = \"central_gravity\"\ncenter = \"sun\"\nstrength = \"G\"\n",
                    "pair");
}

/// A power of 2 of which the time is a multiple, or the time over a power of 2.
TEST(UsualStep, DividesTheTime) {
  EXPECT_EQ(step_of("kepler", "10"), "1/32");
  EXPECT_EQ(step_of("kepler", "1/3"), "(1/3)/2^3");
  EXPECT_EQ(step_of("kepler", "20*pi"), "(20*pi)/2^11");
  EXPECT_EQ(step_of("kepler", "1/1024"), "1/1024");
}

/// With a time scale a million times as long, so is the step.
TEST(UsualStep, FollowsTheUnitsOfTheScene) {
  const PrecisionScope digits(20);
  const auto step = [](const std::string& mass, const std::string& until) {
    return evaluate<Mpfr>(usual_step(pair(mass), Expression::parse(until)));
  };
  EXPECT_EQ(Mpfr(step("2^-40", "2^30") / step("1", "2^10")), Mpfr(1 << 20));
}

TEST(UsualStep, IsRefusedWhereThereIsNoSeries) {
  const PrecisionScope digits(20);
  const Scene falling = read_scene(
      "dimension = 2\npoint = [{ name = \"o\", position = [0, 0] }]\nbody = [{ name = \"a\", mass = 1, "
      "position = [1, 0], velocity = [0, 0] }]\neffect = [{ kind = \"central_gravity\", center = \"o\", strength = 1 "
      "}]\n",
      "falling");
  expect_words(message_of([&] { usual_step(falling, Expression::parse("10")); }), {"no step is given", "say how long"});
  EXPECT_THROW(step_of("kepler", "0"), InputError);
  EXPECT_THROW(step_of("kepler", "-1"), InputError);
}

}  // namespace
}  // namespace hbvm::core
