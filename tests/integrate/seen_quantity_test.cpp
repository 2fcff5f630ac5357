#include "integrate/seen_quantity.hpp"

#include "integrate/observations.hpp"
#include "integrate/output_state.hpp"
#include "integrate/runs.hpp"
#include "printing.hpp"
#include "scalar/literal.hpp"
#include "scene/mechanism.hpp"
#include "scene/observe.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

class SeenQuantityTest : public InDigits<50> {
 protected:
  static void expect_values(const Scene& scene, const std::vector<std::pair<std::string, std::string>>& expected) {
    std::vector<std::string> names;
    for (const auto& [name, value] : expected) names.push_back(name);
    const Vector<Mpfr> found = seen_at_start(scene, names);
    for (std::size_t i = 0; i < expected.size(); ++i) {
      const Mpfr value = literal<Mpfr>(expected[i].second);
      EXPECT_LE(magnitude(Mpfr(found[static_cast<Index>(i)] - value)), 100 * epsilon<Mpfr>() * (1 + magnitude(value)))
          << names[i] << " is " << to_text(found[static_cast<Index>(i)]);
    }
  }
};

/// T = m (v^2/L + g cos) of a pendulum: with the rod straight down, and at the angle whose cosine is 4/5.
TEST_F(SeenQuantityTest, TensionIsThatOfAPendulum) {
  const auto pendulum = [](const std::string& position, const std::string& velocity) {
    return read_scene(
        "dimension = 2\npoint = [{ name = \"o\", position = [0, 0] }]\nbody = [{ name = \"bob\", mass = 3, position "
        "= " +
            position + ", velocity = " + velocity +
            " }]\nconstraint = [{ kind = \"rod\", between = [\"o\", \"bob\"], length = 2 }]\n"
            "effect = [{ kind = \"uniform_gravity\", acceleration = [0, -10] }]\n",
        "pendulum");
  };
  expect_values(pendulum("[0, -2]", "[4, 0]"), {{"tension(o, bob)", "3*(16/2 + 10)"},
                                                {"tension(bob, o)", "3*(16/2 + 10)"},
                                                {"force(bob, o, y)", "54"},
                                                {"force(o, bob, y)", "-54"},
                                                {"force(bob, o, x)", "0"},
                                                {"angle(o, bob)", "-pi/2"},
                                                {"rate(o, bob)", "2"},
                                                {"distance(o, bob)", "2"},
                                                {"speed(bob)", "4"},
                                                {"bob.vx + bob.px + bob.x + o.y + t", "4 + 12"},
                                                {"x(bob) + vy(bob) + px(bob)", "12"},
                                                {"kinetic(bob)", "24"},
                                                {"kinetic()", "24"},
                                                {"potential()", "-60"},
                                                {"energy()", "-36"}});
  expect_values(pendulum("[\"6/5\", \"-8/5\"]", "[0, 0]"),
                {{"tension(o, bob)", "24"}, {"force(bob, o, x)", "-24*3/5"}, {"force(bob, o, y)", "24*4/5"}});
}

/// m a = m g + the forces on a body, with a from the momenta of a run of two small steps.
TEST_F(SeenQuantityTest, ForcesAreWhatABodyIsMovedBy) {
  const std::string lower = "lower[-2/5, 0]", upper = "upper[1, 0]";
  Scene scene = load_scene("double_physical_pendulum");
  for (const char* const axis : {"x", "y"})
    for (const auto& [a, b] : {std::pair(lower, upper), {upper, lower}}) {
      const std::string force = "force(" + a + ", " + b + ", " + axis + ")";
      scene = with_observation(scene, force, force);
    }
  SceneRun<Mpfr> run(scene, 6, 6, "1e-12", "2e-12");
  Recorder<Mpfr> recorder;
  Observations<Mpfr> observations(scene, run.scene.problem);
  Vector<Mpfr> forces;
  struct Middle final : Observer<Mpfr> {
    Observations<Mpfr>& from;
    Vector<Mpfr>& to;
    Middle(Observations<Mpfr>& observed, Vector<Mpfr>& values) : from(observed), to(values) {}
    void observe(const Snapshot<Mpfr>& s) override {
      if (s.n == 1) to = from.values();
    }
  } middle(observations, forces);
  run({&recorder, &observations, &middle});
  // The lower bar's reference point is its centre of mass, of mass 1.
  const auto& seen = recorder.seen;
  StateEvaluator<Mpfr> point(run.scene.problem);
  const Index at = 4;
  for (Index i = 0; i < 2; ++i) {
    const Mpfr before = point.tangential(seen[0].q, seen[0].p)[at + i];
    const Mpfr acceleration = (point.tangential(seen[2].q, seen[2].p)[at + i] - before) / (2 * run.grid.step());
    const Mpfr expected = acceleration + (i == 1 ? 1 : 0);
    EXPECT_LE(magnitude(Mpfr(forces[2 * i] - expected)), literal<Mpfr>("1e-20")) << i;
    EXPECT_EQ(forces[2 * i + 1], -forces[2 * i]);
  }
}

/// m a of each body of a mechanism is its weight and the forces of its joints.
TEST_F(SeenQuantityTest, ForcesOfJointsMoveBodies) {
  const Scene scene = read_scene(mechanism + mechanism_effects, "mechanism.toml");
  const auto between = [](const std::string& a, const std::string& b, char along) {
    return "force(" + a + ", " + b + ", " + along + ")";
  };
  // Each body with the joint to the one before it, on both sides.
  std::vector<std::string> sums;
  for (std::size_t body = 0; body < 5; ++body)
    for (const char along : {'x', 'y', 'z'}) {
      std::string sum;
      if (body > 0) sum = between(mechanism_joints[body - 1][1], mechanism_joints[body - 1][0], along);
      if (body < 4)
        sum += (sum.empty() ? "" : " + ") + between(mechanism_joints[body][0], mechanism_joints[body][1], along);
      if (body == 4) sum += std::string(" + 2*(post.") + along + " - shaft." + along + ")";
      sums.push_back(sum);
    }
  const Vector<Mpfr> found = seen_at_start(scene, sums);
  const Assembled<Mpfr> start = assemble<Mpfr>(scene);
  StateEvaluator<Mpfr> point(start.problem);
  const auto forces = point.forces(start.q0, start.p0);
  const Vector<Mpfr> rate = forces.applied + forces.constraint;
  Vector<Mpfr> acceleration(60);
  start.problem.mass.velocity(lanes(rate), lanes(acceleration));
  for (Index body = 0; body < 5; ++body) {
    const auto& [name, mass, x, y, z] = mechanism_bodies[static_cast<std::size_t>(body)];
    Vector<Mpfr> moved = acceleration.segment(12 * body, 3);
    moved += literal<Mpfr>(x) * acceleration.segment(12 * body + 3, 3) +
             literal<Mpfr>(y) * acceleration.segment(12 * body + 6, 3) +
             literal<Mpfr>(z) * acceleration.segment(12 * body + 9, 3);
    const Vector<Mpfr> expected = (moved - Vector<Mpfr>{{Mpfr(3), Mpfr(-10), Mpfr(1)}}) * literal<Mpfr>(mass);
    EXPECT_LE(distance<Mpfr>(found.segment(3 * body, 3), expected), 10'000 * epsilon<Mpfr>()) << name;
    EXPECT_GE(max_norm(expected), Mpfr(1) / 100) << name;
  }
}

/// A sleeve is told along the axis of the second body, which here is down.
TEST_F(SeenQuantityTest, SlidersAreSomewhereOnTheirRails) {
  expect_values(read_scene(mechanism, "mechanism.toml"), {{"slide(base[0, 0, 0], slider[0, 0, 0])", "2"},
                                                          {"slide(slider[0, 0, 0], base[0, 0, 0])", "-2"},
                                                          {"slide(fork[0, 0, 1], shaft[0, 0, 0])", "-2"}});
  expect_values(
      read_scene("dimension = 2\nrigid_body = [{ name = \"block\", position = [4, 3], velocity = [0, 0], mass "
                 "= 1, inertia = 1, orientation = 1, angular_velocity = 0 }]\n"
                 "point = [{ name = \"o\", position = [0, 0] }]\n"
                 "constraint = [{ kind = \"prismatic\", between = [\"o\", { of = \"block\", at = [0, 0] }], "
                 "axis = [-8, -6] }]\n",
                 "block"),
      {{"slide(o, block[0, 0])", "-5"}});
}

TEST_F(SeenQuantityTest, BarsOfThePlaneTurn) {
  expect_values(load_scene("double_physical_pendulum"),
                {{"angle(upper.d1)", "atan2(-4/5, 3/5)"},
                 {"rate(upper.d1)", "1/2"},
                 {"omega(upper)", "1/2"},
                 {"omega(lower)", "-1"},
                 {"angle(upper.d1, lower.d1)", "atan2(-5/13, 12/13) - atan2(-4/5, 3/5)"},
                 {"rate(upper.d1, lower.d1)", "-3/2"},
                 {"angle(x, lower.d2)", "atan2(12/13, 5/13)"},
                 {"upper.d1.x + upper.d2.vy", "3/5 + 1/2*4/5"},
                 {"distance(upper[1, 0], lower[-2/5, 0])", "0"},
                 {"kinetic(upper) + kinetic(lower) - kinetic()", "0"}});
}

TEST_F(SeenQuantityTest, BodiesOfSpaceTurn) {
  expect_values(load_scene("heavy_top"), {{"omega(top, x)", "1"},
                                          {"omega(top, y)", "3/2"},
                                          {"omega(top, z)", "3"},
                                          {"omega(top, top.d3)", "2/7 + 3/2*3/7 + 3*6/7"},
                                          {"180/pi*angle(top.d3, z)", "180/pi*acos(6/7)"},
                                          {"angle(top.d1, top.d2)", "pi/2"}});
  expect_values(load_scene("gyroscope_on_gimbal"),
                {{"omega(rotor, rotor.d3) - omega(inner, rotor.d3)", "5"}, {"distance(post, rotor)", "1/5"}});
}

TEST_F(SeenQuantityTest, IsRefusedWithWhatThereIs) {
  const Scene plane = load_scene("double_physical_pendulum"), space = load_scene("heavy_top");
  const auto refusal = [](const Scene& scene, const std::string& text) {
    return message_of<InputError>([&] { seen_at_start(scene, {text}); });
  };
  expect_words(refusal(plane, "tension(upper, lower)"), {"observe 'tension(upper, lower)'", "no rod between"});
  expect_words(refusal(plane, "force(upper, lower, x)"),
               {"no rod or joint between", "there is one between", "upper[1, 0] and lower"});
  expect_words(refusal(plane, "force(upper[2, 0], lower, x)"), {"'upper[2, 0]'", "upper[1, 0]"});
  expect_words(refusal(plane, "rate(angle(upper, lower))"), {"rate() takes what angle() takes, as rate(a, b)"});
  expect_words(refusal(plane, "slide(lower[-2/5, 0], upper[1, 0])"), {"nothing slides between"});
  expect_words(refusal(plane, "angel(upper.d1)"), {"did you mean 'angle'"});
  expect_words(refusal(plane, "angle(uper.d1)"), {"no direction", "directors of rigid bodies"});
  expect_words(refusal(plane, "omega(upper, x)"), {"'omega' is omega(a)"});
  expect_words(refusal(plane, "distance(upper)"), {"'distance' is distance(a, b)"});
  expect_words(refusal(plane, "upper.z"), {"'upper' has no 'z'", "x, y, vx"});
  expect_words(refusal(plane, "px(upper)"), {"no momentum of its own"});
  expect_words(refusal(plane, "kinetic(top)"), {"no body 'top'", "upper"});
  expect_words(refusal(plane, "height"), {"there is no 'height'"});
  expect_words(refusal(plane, "7 + pi"), {"names nothing of the motion"});
  expect_words(refusal(space, "angle(top.d3)"), {"between two directions"});
  expect_words(refusal(space, "rate(top.d3, z)"), {"omega"});
  expect_words(refusal(space, "omega(top)"), {"along a direction"});
  expect_words(message_of<IntegrationError>([&] { seen_at_start(space, {"1/(top.d1.vx - top.d1.vx)"}); }),
               {"has no value at t = 0"});
}

}  // namespace
}  // namespace hbvm::core
