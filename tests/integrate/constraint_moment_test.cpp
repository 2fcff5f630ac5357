#include "integrate/constraint_moment.hpp"

#include "integrate/runs.hpp"
#include "linear/product.hpp"
#include "printing.hpp"
#include "problem/state_evaluator.hpp"
#include "scalar/literal.hpp"
#include "scene/assemble.hpp"
#include "scene/mechanism.hpp"
#include "scene/observe.hpp"
#include "scene/scene.hpp"
#include "scene/turning.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

class ConstraintMomentTest : public InDigits<50> {
 protected:
  static void expect_near(const Mpfr& found, const std::string& expected) {
    EXPECT_LE(magnitude(Mpfr(found - literal<Mpfr>(expected))), 1000 * epsilon<Mpfr>()) << to_text(found);
  }
};

/// A beam of mass 3 is held at its end, and its centre is 2 away from there. The moment is m g a.
TEST_F(ConstraintMomentTest, OfABeamAtItsEnd) {
  const std::string plane = R"toml(dimension = 2
point = [{ name = "wall", position = [1, 1] }]
rigid_body = [{ name = "beam", position = [0, 1], velocity = [0, 0], mass = 3, center = [3, 0], inertia = 40, orientation = 0, angular_velocity = 0 }]
constraint = [{ kind = "weld", between = ["wall", { of = "beam", at = [1, 0] }] }]
effect = [{ kind = "uniform_gravity", acceleration = [0, -10] }]
)toml";
  const Vector<Mpfr> found =
      seen_at_start(read_scene(plane, "beam.toml"), {"torque(beam[1, 0], wall)", "torque(wall, beam[1, 0])"});
  expect_near(found[0], "3*10*2");
  expect_near(found[1], "-3*10*2");
  // A body that has a fixed point is held by the orientation alone.
  const std::string space = R"toml(dimension = 3
point = [{ name = "wall", position = [0, 0, 0] }]
rigid_body = [{ name = "beam", fixed_at = [0, 0, 0], mass = 3, center = [0, 2, 1], inertia = [20, 9, 15], orientation = { axis = [1, 0, 0], angle = 0 }, angular_velocity = [0, 0, 0] }]
constraint = [{ kind = "weld", between = ["wall", { of = "beam", at = [0, 0, 0] }] }]
effect = [{ kind = "uniform_gravity", acceleration = [0, 0, -10] }]
)toml";
  const std::string ends = "beam[0, 0, 0], wall, ";
  const Vector<Mpfr> held =
      seen_at_start(read_scene(space, "beam.toml"),
                    {"torque(" + ends + "x)", "torque(" + ends + "y)", "torque(" + ends + "beam.d3)"});
  expect_near(held[0], "3*10*2");
  expect_near(held[1], "0");
  expect_near(held[2], "0");
}

TEST_F(ConstraintMomentTest, IsRefusedWhereNoBodyIsHeld) {
  const Scene pendulum = load_scene("simple_pendulum"), bars = load_scene("double_physical_pendulum");
  expect_words(message_of<InputError>([&] { seen_at_start(pendulum, {"torque(pivot, bob)"}); }),
               {"'pivot'", "rigid body"});
  expect_words(message_of<InputError>([&] { seen_at_start(bars, {"torque(upper, lower)"}); }), {"no rod or joint"});
  expect_words(message_of<InputError>([&] { seen_at_start(bars, {"torque(upper, lower, x)"}); }), {"torque(a, b)"});
}

/// dL/dt of each body is the sum of r x F and of the moments of its joints, of its weight and a spring.
TEST_F(ConstraintMomentTest, OfJointsTurnBodies) {
  const Scene scene = read_scene(mechanism + mechanism_effects, "mechanism.toml");
  const std::string axes = "xyz";
  // The component i of r x F, of vectors that are written by their components.
  const auto across = [&](std::size_t i, const auto& r, const auto& F) {
    const char j = axes[(i + 1) % 3], k = axes[(i + 2) % 3];
    return " + (" + r(j) + ")*(" + F(k) + ") - (" + r(k) + ")*(" + F(j) + ")";
  };
  std::vector<std::string> sums;
  for (std::size_t body = 0; body < 5; ++body)
    for (std::size_t i = 0; i < 3; ++i) {
      std::string sum = "0";
      const auto add_joint = [&](const std::string& a, const std::string& b) {
        sum += " + torque(" + a + ", " + b + ", " + axes[i] + ")" +
               across(
                   i, [&](char c) { return std::string(1, c) + "(" + a + ")"; },
                   [&](char c) { return "force(" + a + ", " + b + ", " + c + ")"; });
      };
      if (body > 0) add_joint(mechanism_joints[body - 1][1], mechanism_joints[body - 1][0]);
      if (body < 4) add_joint(mechanism_joints[body][0], mechanism_joints[body][1]);
      const auto& entries = mechanism_bodies[body];
      const std::string &name = entries[0], &mass = entries[1], &x = entries[2], &y = entries[3], &z = entries[4];
      const auto place = [&](char c) { return name + "." + c; };
      const auto center = [&](char c) {
        return place(c) + " + " + x + "*" + name + ".d1." + c + " + " + y + "*" + name + ".d2." + c + " + " + z + "*" +
               name + ".d3." + c;
      };
      sum += across(i, center, [&](char c) { return mass + "*" + (c == 'x' ? "3" : c == 'y' ? "(-10)" : "1"); });
      if (body == 4)
        sum += across(i, place, [&](char c) { return std::string("2*(post.") + c + " - shaft." + c + ")"; });
      sums.push_back(sum);
    }
  const Vector<Mpfr> found = seen_at_start(scene, sums);
  const Assembled<Mpfr> start = assemble<Mpfr>(scene);
  StateEvaluator<Mpfr> point(start.problem);
  const auto forces = point.forces(start.q0, start.p0);
  const Vector<Mpfr> rate = forces.applied + forces.constraint;
  for (Index body = 0; body < 5; ++body) {
    Vector<Mpfr> expected = Vector<Mpfr>::Zero(3);  // sum q_i x p_i'
    for (Index i = 12 * body; i < 12 * body + 12; i += 3)
      expected += turned(Vector<Mpfr>(start.q0.segment(i, 3)), Vector<Mpfr>(rate.segment(i, 3)));
    EXPECT_LE(distance<Mpfr>(found.segment(3 * body, 3), expected), 10'000 * epsilon<Mpfr>()) << body;
    EXPECT_GE(max_norm(expected), Mpfr(1) / 100) << body;
  }
}

}  // namespace
}  // namespace hbvm::core
