#include "scene/project.hpp"

#include "scene/assembled.hpp"
#include "scene/hold.hpp"
#include "scene/joined_bodies.hpp"
#include "scene/mechanism.hpp"

namespace hbvm::core {
namespace {

template <class S>
class Project : public InDigits<50> {
 protected:
  static Scene projected(const std::string& text) { return project<S>(read_scene(text, "test.toml")); }

  using Numbers = std::vector<std::string>;
  static void expect_near(const SceneVector& found, const Numbers& expected, const char* what) {
    ASSERT_EQ(found.size(), expected.size()) << what;
    for (std::size_t i = 0; i < found.size(); ++i) {
      const S error = evaluate<S>(found[i]) - literal<S>(expected[i]);
      EXPECT_LE(magnitude(error), 64 * epsilon<S>())
          << what << " " << i << " is " << found[i].text() << " instead of " << expected[i];
    }
  }
  static void expect_start(const auto& body, const Numbers& position, const Numbers& velocity) {
    SCOPED_TRACE(body.name);
    expect_near(body.position, position, "position");
    expect_near(body.velocity, velocity, "velocity");
  }
  static void expect_turn(const SceneRigidBody& body, const std::vector<Numbers>& directors, const Numbers& omega) {
    ASSERT_EQ(body.directors.size(), directors.size());
    for (std::size_t a = 0; a < directors.size(); ++a) expect_near(body.directors[a], directors[a], "director");
    expect_near(body.angular_velocity, omega, "angular velocity");
  }
};
TYPED_TEST_SUITE(Project, AllScalars, ScalarNames);

std::string body(const std::string& name, const std::string& mass, const std::string& position,
                 const std::string& velocity = "[0, 0]") {
  return "[[body]]\nname = \"" + name + "\"\nmass = " + mass + "\nposition = " + position + "\nvelocity = " + velocity +
         "\n";
}
const std::string plane_with_origin = "dimension = 2\n[[point]]\nname = \"O\"\nposition = [0, 0]\n";

/// The nearest point of a circle is on the radius; of the velocity the part along it goes.
TYPED_TEST(Project, OnACircleMovesAlongTheRadius) {
  const Scene scene = this->projected(plane_with_origin + body("a", "3", "[0.75, 1]", "[1, 0]") + rod("O", "a", "1"));
  this->expect_start(scene.bodies[0], {"3/5", "4/5"}, {"16/25", "-12/25"});
}

/// (9/5, 12/5) is (6/5, 4/5), on the ellipse x^2 + 4 y^2 = 4, and a quarter of the gradient there. The sweeps converge
/// by a factor 2/3 each and must go on to the last digit. An end at the first small increment would leave some 80
/// epsilon.
TYPED_TEST(Project, ConvergesSlowlyToRoundOff) {
  using S = TypeParam;
  const Scene scene =
      this->projected("dimension = 2\n" + body("a", "1", "[\"9/5\", \"12/5\"]") +
                      "[[constraint]]\nkind = \"quadric\"\nbody = \"a\"\nA = [[1, 0], [0, 4]]\nb = [0, 0]\nc = -4\n");
  EXPECT_LE(magnitude(S(evaluate<S>(scene.bodies[0].position[0]) - literal<S>("6/5"))), 24 * epsilon<S>());
  EXPECT_LE(magnitude(S(evaluate<S>(scene.bodies[0].position[1]) - literal<S>("4/5"))), 24 * epsilon<S>());
}

/// Onto constraints by formulas: the circle by its radius, and a torus, whose nearest point is that of its tube.
TYPED_TEST(Project, OntoSurfacesByFormulas) {
  const auto formula = [](const char* g) {
    return std::string("[[constraint]]\nkind = \"formula\"\non = \"a\"\ng = \"") + g + "\"\n";
  };
  const Scene circle =
      this->projected("dimension = 2\n" + body("a", "3", "[0.75, 1]", "[1, 0]") + formula("sqrt(x^2 + y^2) - 1"));
  this->expect_start(circle.bodies[0], {"3/5", "4/5"}, {"16/25", "-12/25"});
  // 5/4 (3/5, 4/5) off the circle of centres; the velocity along the axis loses what is across the tube.
  const Scene torus = this->projected("dimension = 3\n" + body("a", "2", "[2.75, 0, 1]", "[0, 7, 5]") +
                                      formula("(sqrt(x^2 + y^2) - 2)^2 + z^2 - 1"));
  this->expect_start(torus.bodies[0], {"13/5", "0", "4/5"}, {"-12/5", "7", "9/5"});
}

TYPED_TEST(Project, HasAllDigitsOfThePrecision) {
  const Scene scene = this->projected(plane_with_origin + body("a", "1", "[0.7, 0.7]") + rod("O", "a", "1"));
  this->expect_near(scene.bodies[0].position, {"sqrt(1/2)", "sqrt(1/2)"}, "position");
}

/// To the nearest point in the metric M bodies move inversely to their masses.
TYPED_TEST(Project, SharesADisplacementInverselyToTheMasses) {
  const Scene scene = this->projected("dimension = 2\n" + body("a", "1", "[0, 0]", "[1, 1]") +
                                      body("b", "3", "[2, 0]", "[-1, 0]") + rod("a", "b", "1"));
  // Both keep the velocity of their centre of mass, along the rod.
  this->expect_start(scene.bodies[0], {"3/4", "0"}, {"-1/2", "1"});
  this->expect_start(scene.bodies[1], {"7/4", "0"}, {"-1/2", "0"});
}

/// q = q0 - W n (n.q0 - offset)/(n.W n), v = v0 - W n (n.v0)/(n.W n) with W = M^-1.
TYPED_TEST(Project, OntoAPlaneInTheMetricOfAMassMatrix) {
  const auto on_plane = [&](const std::string& mass, const std::string& normal, const char* offset) {
    return this->projected("dimension = 2\n" + body("a", mass, "[0, 0]", "[1, 0]") +
                           "[[constraint]]\nkind = \"plane\"\nbody = \"a\"\nnormal = " + normal +
                           "\noffset = " + offset + "\n");
  };
  // W = diag(1, 1/4), W n = (1, 1/4), n.W n = 5/4
  const Scene diagonal = on_plane("[[1, 0], [0, 4]]", "[1, 1]", "5");
  this->expect_start(diagonal.bodies[0], {"4", "1"}, {"1/5", "-1/5"});
  // W = [[1, -1], [-1, 2]], W n = (1, -1), n.W n = 1
  const Scene full = on_plane("[[2, 1], [1, 1]]", "[1, 0]", "3");
  this->expect_start(full.bodies[0], {"3", "-3"}, {"0", "1"});
}

TYPED_TEST(Project, KeepsTheMomentumThatASceneGives) {
  std::string text = plane_with_origin + body("a", "4", "[0, -1]", "[2, 3]") + rod("O", "a", "1");
  const Scene scene = this->projected(changed(text, "velocity", "momentum"));
  EXPECT_TRUE(scene.bodies[0].velocity.empty());
  this->expect_near(scene.bodies[0].momentum, {"2", "0"}, "momentum");
}

TYPED_TEST(Project, WithoutConstraintsChangesNothing) {
  const Scene scene = this->projected("dimension = 2\n" + body("a", "2", "[0.1, \"1/3\"]", "[0.7, 2]"));
  EXPECT_EQ(evaluate<TypeParam>(scene.bodies[0].position[0]), literal<TypeParam>("0.1"));
  EXPECT_EQ(scene.bodies[0].position[1].text(), "1/3");
  EXPECT_EQ(evaluate<TypeParam>(scene.bodies[0].velocity[0]), literal<TypeParam>("0.7"));
  EXPECT_EQ(evaluate<TypeParam>(scene.bodies[0].velocity[1]), 2);
}

std::string rigid(const std::string& place, const std::string& directors, const std::string& omega) {
  return "dimension = 3\n[[rigid_body]]\nname = \"top\"\n" + place +
         "mass = 1\ncenter = [0, 0, 0]\nsecond_moment = [[2, 0, 0], [0, 2, 0], [0, 0, 2]]\ndirectors = " + directors +
         "\nangular_velocity = " + omega + "\n";
}

/// With equal moments the metric is that of the matrix D of directors. The nearest rotation is the factor R of D = P R,
/// P symmetric and positive definite. Here P = [[11, 1, 0], [1, 9, 0], [0, 0, 12]]/10.
TYPED_TEST(Project, OfDirectorsIsTheirPolarFactor) {
  const Scene scene = this->projected(rigid(
      "fixed_at = [1, 2, 3]\n",
      R"([["20/30", "23/30", "13/30"], ["-16/30", "11/30", "19/30"], ["12/30", "-24/30", "24/30"]])", "[0, 0, 0]"));
  const SceneRigidBody& top = scene.rigid_bodies[0];
  this->expect_turn(top, {{"2/3", "2/3", "1/3"}, {"-2/3", "1/3", "2/3"}, {"1/3", "-2/3", "2/3"}}, {"0", "0", "0"});
  this->expect_near(top.position, {"1", "2", "3"}, "fixed point");
  EXPECT_TRUE(top.velocity.empty());
}

/// Directors 5/4 times too long turn at omega: their rates are 5/4 omega x d.
TYPED_TEST(Project, OfARigidBodyKeepsPositionAndRates) {
  const Scene scene = this->projected(rigid("position = [1, 2, 3]\nvelocity = [4, 5, 6]\n",
                                            "[[0, 1.25, 0], [-1.25, 0, 0], [0, 0, 1.25]]", "[1, 2, -4]"));
  const SceneRigidBody& top = scene.rigid_bodies[0];
  this->expect_start(top, {"1", "2", "3"}, {"4", "5", "6"});
  this->expect_turn(top, {{"0", "1", "0"}, {"-1", "0", "0"}, {"0", "0", "1"}}, {"5/4", "5/2", "-5"});
}

/// In the plane the nearest rotation of directors 5/4 times too long is by the same angle, at 5/4 the rate.
TYPED_TEST(Project, OfAPlanarRigidBodyKeepsPositionAndRates) {
  const Scene scene = this->projected(
      "dimension = 2\n[[rigid_body]]\nname = \"plate\"\nposition = [1, 2]\nvelocity = [4, 5]\nmass = 1\n"
      "center = [0, 0]\nsecond_moment = [[2, 0], [0, 2]]\ndirectors = [[0.75, 1], [-1, 0.75]]\n"
      "angular_velocity = -4\n");
  const SceneRigidBody& plate = scene.rigid_bodies[0];
  this->expect_start(plate, {"1", "2"}, {"4", "5"});
  this->expect_turn(plate, {{"3/5", "4/5"}, {"-4/5", "3/5"}}, {"-5"});
}

/// Bodies that were drawn apart are joined again.
TYPED_TEST(Project, OfJoinedBodiesIsAccepted) {
  const std::string text = changed(joined_bodies, "position = [\"3/2\", 0, 0]", "position = [1.49, 0.01, 0]");
  EXPECT_THROW(assembled<TypeParam>(text), InputError);
  const Scene joined = this->projected(text);
  EXPECT_EQ(joined.attachments.size(), 11u);
  EXPECT_EQ(assemble<TypeParam>(joined).problem.nu(), 28);
}

TYPED_TEST(Project, IsAcceptedAndKeepsWhatItDoesNotMove) {
  std::string text = changed(every_key, "position = [\"3/5\", 0, -0.8]", "position = [0.61, 0.02, -0.8]");
  text = changed(text, "velocity = [2, -1, 0]", "velocity = [2, -1, 0.1]");
  const Scene before = read_scene(text, "test.toml");
  EXPECT_THROW(assemble<TypeParam>(before), InputError);
  const Scene after = project<TypeParam>(before);
  const auto accepted = assemble<TypeParam>(after);
  EXPECT_EQ(accepted.problem.nu(), 16);
  EXPECT_EQ(after.title, before.title);
  EXPECT_EQ(after.constants.size(), before.constants.size());
  EXPECT_EQ(after.effects.size(), before.effects.size());
  for (std::size_t i = 0; i < before.bodies.size(); ++i) {
    EXPECT_EQ(after.bodies[i].name, before.bodies[i].name);
    EXPECT_EQ(after.bodies[i].mass.has_value(), before.bodies[i].mass.has_value());
    EXPECT_EQ(after.bodies[i].charge.has_value(), before.bodies[i].charge.has_value());
  }
  // The stone touches nothing: it stays where it is.
  this->expect_near(after.rigid_bodies[1].position, {"5", "6", "7"}, "stone");
  this->expect_near(after.rigid_bodies[1].angular_velocity, {"2", "3", "5"}, "stone");
}

TYPED_TEST(Project, OfAConsistentSceneIsTheSceneItself) {
  for (const auto& [name, text] : built_in_scenes()) {
    const Scene scene = read_scene(text, name);
    const auto before = assemble<TypeParam>(scene), after = assemble<TypeParam>(project<TypeParam>(scene));
    const TypeParam tolerance = 1'000 * epsilon<TypeParam>();
    EXPECT_LE(max_norm(Vector<TypeParam>(after.q0 - before.q0)), tolerance * max_norm(before.q0)) << name;
    EXPECT_LE(max_norm(Vector<TypeParam>(after.p0 - before.p0)), tolerance * (1 + max_norm(before.p0))) << name;
  }
}

TYPED_TEST(Project, RefusesWhatCannotBeMadeConsistent) {
  // From pins 1 apart no point is at 1 and at 5.
  const std::string apart = plane_with_origin + "[[point]]\nname = \"A\"\nposition = [1, 0]\n" +
                            body("a", "1", "[0.5, 0.8]") + rod("O", "a", "1") + rod("A", "a", "5");
  // On the pin every direction is as near as any other.
  const std::string centre = plane_with_origin + body("a", "1", "[0, 0]") + rod("O", "a", "1");
  // The same rod twice is redundant, and takes nothing away.
  const std::string twice = plane_with_origin + body("a", "1", "[0, 1]") + rod("O", "a", "1") + rod("O", "a", "1");
  EXPECT_NO_THROW(this->projected(twice));
  for (const std::string& text : {apart, centre}) {
    const std::string message = refused([&] { this->projected(text); });
    EXPECT_TRUE(message.starts_with("test.toml: no consistent position")) << text << message;
  }
}

/// Joints that hold what is at the start, as a weld its angle, hold it after a projection. A second one changes
/// nothing.
TYPED_TEST(Project, OfAMechanismIsOne) {
  using S = TypeParam;
  std::string text = changed(mechanism, "position = [2, 1, 4]", "position = [2.01, 1.003, 4]");
  text = changed(text, "angular_velocity = [0, 0, 3]", "angular_velocity = [0.01, 0, 3]");
  text = changed(text, "[[0, 1, 0], [-1, 0, 0], [0, 0, 1]]", "[[0, 1, 0.002], [-1, 0, 0], [0.001, 0, 1]]");
  EXPECT_NE(inconsistency<S>(text), "");
  const Scene scene = this->projected(text);
  const Assembled<S> start = assemble<S>(scene);
  EXPECT_EQ(start.problem.m() - start.problem.nu(), 11);
  const Assembled<S> again = assemble<S>(project<S>(scene));
  EXPECT_LE(distance(start.q0, again.q0), 64 * epsilon<S>());
  EXPECT_LE(distance(start.p0, again.p0), 256 * epsilon<S>());
}

/// A director of a door that turns about x has a component that is 0 but for rounding. Its hold holds.
TYPED_TEST(Project, HoldsAnAngleInSpace) {
  using S = TypeParam;
  const Scene scene = read_scene(R"(
dimension = 3
point = [{ name = "A", position = [0, 0, 0] }]
effect = [{ kind = "uniform_gravity", acceleration = [0, 0, -9.81] }]
[[rigid_body]]
name = "door"
position = ["1/100", 0, 0]
velocity = [0, 0, 0]
angular_velocity = [0, 0, 0]
mass = 2
center = [0, 0.2, 0]
inertia = [0.05, 0.04, 0.08]
orientation = { axis = [1, 0, 0], angle = "-15*pi/180" }
[[constraint]]
kind = "hinge"
between = [{ of = "door", at = [0, 0, 0] }, "A"]
axis = [1, 0, 0]
)",
                                 "door.toml");
  const Assembled<S> sketch = assemble<S>(scene, Consistency::unchecked),
                     start = assemble<S>(project<S>(scene, held_parts(scene, {"door.angle"})));
  EXPECT_LE(max_norm(Vector<S>(start.q0.head(3))), 64 * epsilon<S>());
  EXPECT_LE(distance(Vector<S>(sketch.q0.tail(9)), Vector<S>(start.q0.tail(9))), 64 * epsilon<S>());
}

}  // namespace
}  // namespace hbvm::core
