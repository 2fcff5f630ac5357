#include "study/conservation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>

namespace hbvm::core {
namespace {

using Kind = ConservedQuantity::Kind;

/// A body of mass 2 on a circle of radius 8, and what pulls it.
Scene circle(const std::string& effect) {
  return read_scene(
      "dimension = 2\npoint = [{ name = \"O\", position = [0, 0] }]\n"
      "body = [{ name = \"a\", mass = 2, position = [8, 0], velocity = [0, 1] }]\n"
      "constraint = [{ kind = \"rod\", between = [\"O\", \"a\"], length = 8 }]\neffect = [{ " +
          effect + " }]\n",
      "circle");
}
const std::string well = "kind = \"trap\", center = \"O\", stiffness = 1, exponent = 2",
                  uniform = "kind = \"uniform_gravity\", acceleration = [0, -1]",
                  quartic_attraction = "kind = \"spring\", between = [\"a\", \"O\"], stiffness = 1, exponent = 4";

Conservation after(const Scene& scene, int s, Nodes nodes) {
  return conservation({&scene, s, nodes, Expression::parse("1/16"), Expression::parse("8")},
                      Precision::parse("double"));
}

TEST(Conservation, OfMoreNodesTakesThoseOfAutoOrTwiceAsMany) {
  EXPECT_EQ(after(circle(uniform), 2, Nodes::s).method.k, 2);
  EXPECT_EQ(after(circle(uniform), 2, Nodes::more).method.k, 4) << "hbvm:auto takes 2";
  EXPECT_EQ(after(circle(quartic_attraction), 3, Nodes::s).method.k, 3);
  EXPECT_EQ(after(circle(quartic_attraction), 3, Nodes::more).method.k, 6) << "of hbvm:auto";
}

/// H and L in units of their terms: p^2/(2 m) = 1 and U = 32, L = 16. g = q^2 - 64, whose displacements, of two
/// coordinates up to 8, carry the round-off of positions of that size.
TEST(Conservation, IsMeasuredInUnitsOfTheTerms) {
  const Conservation found = after(circle(well), 2, Nodes::s);
  EXPECT_EQ(found.steps, 128);
  std::map<Kind, const ConservedQuantity*> by_kind;
  for (const ConservedQuantity& quantity : found.quantities) by_kind[quantity.kind] = &quantity;
  EXPECT_EQ(by_kind.size(), 3u) << "a centre takes the linear momentum";
  const auto size = [&](Kind kind) {
    const ConservedQuantity& quantity = *by_kind.at(kind);
    EXPECT_LE(quantity.ulps, found.round_off());
    return std::stod(quantity.drift) / (quantity.ulps * std::numeric_limits<double>::epsilon());
  };
  const auto expect_within = [](double value, double low, double high) {
    EXPECT_GE(value, low);
    EXPECT_LE(value, high);
  };
  expect_within(size(Kind::energy), 32.5, 33.5);
  expect_within(size(Kind::angular_momentum), 15.5, 32);
  expect_within(size(Kind::constraints), 128, 512);
}

/// A few roundings each step, of either sign.
TEST(Conservation, RoundOffWalks) {
  Conservation found;
  for (const long steps : {1L, 100L, 10'000L}) {
    found.steps = steps;
    EXPECT_NEAR(found.round_off(), 16 * (1 + std::sqrt(double(steps))), 1e-9);
  }
}

}  // namespace
}  // namespace hbvm::core
