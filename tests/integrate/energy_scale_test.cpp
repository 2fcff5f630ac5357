#include "integrate/energy_scale.hpp"

#include <cmath>

#include "printing.hpp"
#include "scene/assemble.hpp"

namespace hbvm::core {
namespace {

/// A free body of mass 1: T = p^2/2, sensitive to p by p^2.
TEST(EnergyScale, KeepsTheGreatestOfTheMesh) {
  const Assembled<double> scene = assemble<double>(
      read_scene("dimension = 2\nbody = [{ name = \"a\", mass = 1, position = [0, 0], velocity = [2, 0] }]\n", "test"));
  EnergyScale<double> scale(scene.problem);
  for (const double p : {2.0, 4.0, 1.0}) scale.observe({0, 0, scene.q0, Vector<double>{{p, 0}}, {}});
  EXPECT_DOUBLE_EQ(scale.size(), 8);
  EXPECT_DOUBLE_EQ(scale.round_off(0), epsilon<double>() * (16 + 8) * 2 * std::sqrt(2));
  EXPECT_DOUBLE_EQ(scale.round_off(98), epsilon<double>() * (16 + 8) * 2 * 10);
}

}  // namespace
}  // namespace hbvm::core
