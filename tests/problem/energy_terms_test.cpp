#include "problem/energy_terms.hpp"

#include "printing.hpp"
#include "problem/state_evaluator.hpp"
#include "scene/assemble.hpp"

namespace hbvm::core {
namespace {

template <class S>
class EnergyOfTerms : public InDigits<50> {};
TYPED_TEST_SUITE(EnergyOfTerms, AllScalars, ScalarNames);

TYPED_TEST(EnergyOfTerms, IsThatOfAPoint) {
  using S = TypeParam;
  for (const auto& [name, text] : built_in_scenes()) {
    const Assembled<S> scene = assemble<S>(load_scene(name));
    EnergyTerms<S> terms(scene.problem);
    StateEvaluator<S> point(scene.problem);
    terms.evaluate(scene.q0, scene.p0);
    const S difference = magnitude(S(terms.H() - point.energy(scene.q0, scene.p0)));
    EXPECT_LE(difference, terms.count() * epsilon<S>() * terms.size()) << name;
    EXPECT_LE(point.energy_size(scene.q0, scene.p0), 2 * terms.size()) << name;
  }
}

/// A spring of stiffness 3 and rest length 2 along x, stretched to 4 between bodies at 1 and 5. They move with 2 and 4
/// and have masses 1 and 1/2. So T = 2 + 4, |U| = 3/2 2^2 = 6, and |dU/dx| = 6 times 4 + (1 + 5).
TEST(EnergyTermsByHand, OfASpring) {
  const Assembled<double> scene = assemble<double>(
      read_scene("dimension = 2\nbody = [{ name = \"a\", mass = 1, position = [1, 0], velocity = [2, 0] },\n"
                 " { name = \"b\", mass = \"1/2\", position = [5, 0], velocity = [0, -4] }]\n"
                 "effect = [{ kind = \"spring\", between = [\"a\", \"b\"], stiffness = 3, rest_length = 2 }]\n",
                 "test"));
  EnergyTerms<double> terms(scene.problem);
  terms.evaluate(scene.q0, scene.p0);
  EXPECT_DOUBLE_EQ(terms.H(), 12);
  EXPECT_DOUBLE_EQ(terms.size(), 12);
  EXPECT_DOUBLE_EQ(terms.round_off_size(), 12 + 12 + 6 * (4 + 6));
  EXPECT_EQ(terms.count(), 5);
}

/// Terms that cancel do not cancel in the size: a body between two equal charges of opposite signs.
TEST(EnergyTermsByHand, OfChargesThatCancel) {
  const Assembled<double> scene = assemble<double>(read_scene(
      "dimension = 2\nbody = [{ name = \"a\", mass = 1, charge = 1, position = [0, 0], velocity = [0, 0] }]\n"
      "point = [{ name = \"P\", position = [1, 0], charge = 2 }, { name = \"N\", position = [-1, 0], charge = -2 }]\n"
      "effect = [{ kind = \"coulomb\", strength = 1 }]\n",
      "test"));
  EnergyTerms<double> terms(scene.problem);
  terms.evaluate(scene.q0, scene.p0);
  EXPECT_EQ(terms.H(), 0);
  EXPECT_DOUBLE_EQ(terms.size(), 4);
  EXPECT_DOUBLE_EQ(terms.round_off_size(), 4 + 4);
}

}  // namespace
}  // namespace hbvm::core
