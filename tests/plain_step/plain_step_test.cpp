#include "plain_step/plain_step.hpp"

#include <gtest/gtest.h>

#include "method/hbvm_name.hpp"
#include "plain_step/mechanics.hpp"
#include "printing.hpp"
#include "scene/assemble.hpp"
#include "step/hbvm_stepper.hpp"

namespace hbvm::core {
namespace {

/// Masses of 1000, 1 and 1/1000 on rods, and two charges.
constexpr const char* uneven = R"(
dimension = 2
point = [{ name = "O", position = [0, 0] }]
body = [
  { name = "a", mass = 1000, charge = 20, position = [1, 0], velocity = [0, "1/2"] },
  { name = "b", mass = 1, position = ["8/5", "4/5"], velocity = ["-2/3", 1] },
  { name = "c", mass = "1/1000", charge = "1/1000", position = ["8/5", "9/5"], velocity = [1, 1] },
]
constraint = [
  { kind = "rod", between = ["O", "a"], length = 1 },
  { kind = "rod", between = ["a", "b"], length = 1 },
  { kind = "rod", between = ["b", "c"], length = 1 },
]
effect = [{ kind = "uniform_gravity", acceleration = [0, -1] }, { kind = "coulomb", strength = 1 }]
)";

Scene scene_of(const std::string& name) {
  if (name == "uneven") return read_scene(uneven, name);
  return name == "ellipsoid_bead" ? load_scene(scene_path(name)) : load_scene(name);
}

template <class S>
class PlainStep : public InDigits<50> {
 protected:
  /// Three steps of either lead to the same state and multiplier, but for rounding. That is of the momenta, by their
  /// greatest, and of the multipliers, which come from momenta over the step.
  static void expect_same_states(const std::string& name, const HbvmName& n) {
    const Assembled<S> start = assemble<S>(scene_of(name));
    const S h = S(1) / 20;
    const plain::Step<S> plain_step(mechanics_of(start.problem), n.k, n.s, n.r, h);
    plain::State<S> expected{start.q0, start.p0, {}};
    for (int steps = 0; steps < 3; ++steps) expected = plain_step(expected);

    const Hbvm<S> method = make_hbvm<S>(n.k, n.s, n.r);
    for (const SolverKind kind : {SolverKind::newton, SolverKind::fixed_point}) {
      HbvmStepper<S> stepper(start.problem, method, kind);
      State<S> state(start.q0, start.p0);
      StepResult<S> step;
      for (int steps = 0; steps < 3; ++steps) step = stepper.step(state, h);
      const auto expect_same = [&](const Vector<S>& a, const Vector<S>& b, int roundings, const char* what) {
        EXPECT_LE(distance(a, b), S(roundings * epsilon<S>() * max_norm(b)))
            << what << " of " << name << ", " << n.text() << ", " << name_of(kind);
      };
      expect_same(state.q, expected.q, 4, "q");
      expect_same(state.p, expected.p, 64, "p");
      expect_same(*step.multiplier, expected.lambda, 1 << 15, "lambda");
    }
  }
};
TYPED_TEST_SUITE(PlainStep, AllScalars, ScalarNames);

TYPED_TEST(PlainStep, OfQuadraticConstraintsLeadsToTheStatesOfTheLibrarys) {
  const std::vector<HbvmName> methods{{1, 1, 1}, {3, 1, 1}, {2, 2, 2}, {3, 2, 2}, {5, 3, 3}, {4, 4, 4}, {9, 5, 5}};
  const std::vector<const char*> scenes{"four_bar_linkage_of_bars", "heavy_top",      "tethered_satellites", "uneven",
                                        "double_pendulum",          "ellipsoid_bead", "modified_pendulum"};
  // All pairs in double. In more digits each with two, so that many coordinates do not meet many stages.
  for (std::size_t i = 0; i < methods.size(); ++i)
    for (std::size_t j = 0; j < scenes.size(); ++j)
      if (std::same_as<TypeParam, double> || i == j || i == (j + 3) % scenes.size())
        this->expect_same_states(scenes[j], methods[i]);
}

TYPED_TEST(PlainStep, OfAnyConstraintsLeadsToTheStatesOfTheLibrarys) {
  for (const HbvmName& n : {HbvmName{1, 1, 2}, {3, 2, 4}, {4, 3, 4}})
    for (const char* name : {"bead_on_torus", "rope_over_two_pegs", "uneven"}) this->expect_same_states(name, n);
}

/// A step too long for the iteration (55) is no step.
TEST(PlainStepTooLong, Throws) {
  const Assembled<double> start = assemble<double>(load_scene("double_pendulum"));
  const plain::Step<double> step(mechanics_of(start.problem), 3, 3, 3, 10);
  EXPECT_THROW(step({start.q0, start.p0, {}}), std::runtime_error);
}

}  // namespace
}  // namespace hbvm::core
