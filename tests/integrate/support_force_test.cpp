#include "integrate/support_force.hpp"

#include "integrate/runs.hpp"
#include "scene/assembled.hpp"
#include "scene/observe.hpp"
#include "scene/scene_text.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

/// A chain: `first` hangs on a post, and `second` on it. A spring, a rod and charges pull at points of both.
std::string chain(const std::string& held, const std::string& more) {
  return R"(dimension = 3
[[point]]
name = "post"
position = ["1/2", 0, "1/3"]
[[point]]
name = "hook"
position = [1, 2, "-1/2"]
charge = 2
[[body]]
name = "bead"
mass = 3
position = [2, 1, 0]
velocity = [1, 0, "-1/2"]
[[rigid_body]]
name = "other"
position = [3, 3, 3]
velocity = [0, 1, 0]
mass = 1
center = [0, 0, 0]
inertia = [1, 1, 1]
orientation = { axis = [1, 0, 0], angle = 0 }
angular_velocity = [0, 0, 1]
[[rigid_body]]
name = "first"
)" + held +
         R"(
mass = 2
center = [0, "1/10", "-1/5"]
second_moment = [["1/2", "1/20", 0], ["1/20", "1/3", "1/30"], [0, "1/30", "1/4"]]
directors = [["2/3", "2/3", "1/3"], ["-2/3", "1/3", "2/3"], ["1/3", "-2/3", "2/3"]]
angular_velocity = [1, "-1/2", 2]
[[rigid_body]]
name = "second"
position = ["7/6", "2/3", "2/3"]
velocity = ["-3/2", 1, 1]
mass = "3/2"
center = ["1/5", 0, "1/7"]
second_moment = [["1/2", 0, 0], [0, "1/3", "1/30"], [0, "1/30", "1/4"]]
directors = [[0, 1, 0], [-1, 0, 0], [0, 0, 1]]
angular_velocity = [0, 1, "1/3"]
[[attachment]]
name = "tip"
of = "first"
at = [0, 2, 1]
charge = "1/2"
[[constraint]]
kind = "ball_joint"
between = [{ of = "first", at = [1, 0, 0] }, { of = "second", at = [0, 0, 0] }]
[[constraint]]
kind = "formula"
on = "bead"
g = "y - 1"
[[effect]]
kind = "uniform_gravity"
acceleration = ["1/3", -1, "1/2"]
[[effect]]
kind = "spring"
stiffness = 3
rest_length = 1
between = [["hook", { of = "first", at = [1, 0, 2] }], [{ of = "first", at = [0, 1, 0] }, "bead"]]
[[effect]]
kind = "coulomb"
strength = 5
[[effect]]
kind = "formula"
of = ["first", "second"]
U = "-x1^2*y2"
)" + more;
}

const std::string at_the_post = R"(fixed_at = ["1/2", 0, "1/3"])",
                  free_of_it = "position = [\"1/2\", 0, \"1/3\"]\nvelocity = [0, 0, 0]";
const std::string joint_to_the_post =
    "[[constraint]]\nkind = \"ball_joint\"\nbetween = [{ of = \"first\", at = [0, 0, 0] }, \"post\"]\n";

class SupportForceTest : public InDigits<50> {};

/// m a of all bodies together, less the weight of all: what the supports do. Masses and accelerations are of the
/// centres.
Vector<Mpfr> held_up(const Scene& scene, const Vector<Mpfr>& gravity) {
  const Assembled<Mpfr> start = assemble<Mpfr>(scene);
  StateEvaluator<Mpfr> point(start.problem);
  const auto forces = point.forces(start.q0, start.p0);
  const Vector<Mpfr> rate = forces.applied + forces.constraint;
  Vector<Mpfr> acceleration(start.problem.m());
  start.problem.mass.velocity(lanes(rate), lanes(acceleration));
  const auto number = [&](const Expression& e) { return evaluate<Mpfr>(e, scene.constants); };
  Vector<Mpfr> sum = Vector<Mpfr>::Zero(scene.dimension);
  Index offset = 0;
  for (const SceneRigidBody& body : scene.rigid_bodies) {
    const Mpfr mass = number(body.mass);
    sum -= gravity * mass;
    if (!body.fixed) {
      sum += mass * acceleration.segment(offset, scene.dimension);
      offset += scene.dimension;
    }
    for (const Expression& c : body.center) {
      sum += mass * number(c) * acceleration.segment(offset, scene.dimension);
      offset += scene.dimension;
    }
  }
  return sum;
}

/// The body with its reference point free, and a ball joint there: the same force.
TEST_F(SupportForceTest, IsThatOfABallJointThere) {
  const std::string rod =
      "[[constraint]]\nkind = \"rod\"\nbetween = [\"bead\", { of = \"first\", at = [0, 0, 1] }]\n"
      "length = \"sqrt(185)/6\"\n";
  for (const std::string& more : {std::string(), rod}) {
    std::vector<std::string> own, of_joint;
    for (const char* const along : {"x", "y", "z", "first.d2"}) {
      own.push_back("force(first, " + std::string(along) + ")");
      of_joint.push_back("force(first[0, 0, 0], post, " + std::string(along) + ")");
    }
    const Vector<Mpfr> found = seen_at_start(read_scene(chain(at_the_post, more), "fixed"), own),
                       expected =
                           seen_at_start(read_scene(chain(free_of_it, more + joint_to_the_post), "free"), of_joint);
    for (Index i = 0; i < found.size(); ++i) {
      EXPECT_GE(magnitude(expected[i]), Mpfr(1) / 10) << own[static_cast<std::size_t>(i)];
      EXPECT_LE(magnitude(Mpfr(found[i] - expected[i])), 10'000 * epsilon<Mpfr>()) << own[static_cast<std::size_t>(i)];
    }
  }
}

/// In the plane, where a closed loop has two supports: with the spring they carry what moves all of it.
TEST_F(SupportForceTest, OfALoopIsWhatMovesAllOfIt) {
  const Scene scene = load_scene("four_bar_linkage_of_bars");
  const Vector<Mpfr> found =
      seen_at_start(scene, {"force(crank, x) + force(rocker, x) + 3/2*(ceiling.x - apex.x)",
                            "force(crank, y) + force(rocker, y) + 3/2*(ceiling.y - apex.y)", "force(crank, x)"});
  const Vector<Mpfr> expected = held_up(scene, Vector<Mpfr>{{Mpfr(0), Mpfr(-1)}});
  EXPECT_LE(distance<Mpfr>(found.head(2), expected), 10'000 * epsilon<Mpfr>());
  EXPECT_GE(magnitude(found[2]), Mpfr(1) / 10);
}

/// Two bodies are held at one place, where their hinge has no common point to hold.
TEST_F(SupportForceTest, OfRingsAtOnePlaceAddsUp) {
  const Scene scene = load_scene("gyroscope_on_gimbal");
  std::vector<std::string> sums;
  for (const char* const along : {"x", "y", "z"})
    sums.push_back("force(outer, " + std::string(along) + ") + force(inner, " + along + ")");
  const Vector<Mpfr> expected = held_up(scene, Vector<Mpfr>{{Mpfr(0), Mpfr(0), Mpfr(-1)}});
  EXPECT_LE(distance(seen_at_start(scene, sums), expected), 10'000 * epsilon<Mpfr>());
  EXPECT_GE(expected[2], Mpfr(2));
}

/// A hinge at a second point of the axis says again what holds the first. What both bear is known, their shares are
/// those of least multipliers.
TEST_F(SupportForceTest, SharesWithAHingeThatFollowsFromIt) {
  const Scene scene = read_scene(R"(dimension = 3
[[point]]
name = "upper"
position = [0, 0, 2]
[[rigid_body]]
name = "door"
fixed_at = [0, 0, 0]
mass = 3
center = ["1/2", 0, 1]
inertia = ["1/2", "1/2", "1/4"]
orientation = { axis = [0, 0, 1], angle = 0 }
angular_velocity = [0, 0, 2]
[[constraint]]
kind = "hinge"
between = ["upper", { of = "door", at = [0, 0, 2] }]
axis = [0, 0, 1]
[[effect]]
kind = "uniform_gravity"
acceleration = [2, 4, -10]
)",
                                 "door");
  const Vector<Mpfr> found = seen_at_start(
      scene, {"force(door, x) + force(door[0, 0, 2], upper, x)", "force(door, y) + force(door[0, 0, 2], upper, y)",
              "force(door, z) + force(door[0, 0, 2], upper, z)"});
  // The moment of inertia about the axis is 1, and the torque 6. So the centre of mass gets 3 along y, and 2 towards
  // the axis.
  EXPECT_LE(distance(found, Vector<Mpfr>{{Mpfr(-12), Mpfr(-3), Mpfr(30)}}), 10'000 * epsilon<Mpfr>());
}

/// A field about a centre leaves out a body whose centre of mass is fixed. Something must hold it nevertheless.
TEST_F(SupportForceTest, HoldsAgainstWhatCannotMoveTheBody) {
  const Scene scene = read_scene(R"(dimension = 3
[[point]]
name = "sun"
position = [0, 0, 0]
[[body]]
name = "moon"
mass = 1
position = [3, 0, 0]
velocity = [0, 1, 0]
[[rigid_body]]
name = "wheel"
fixed_at = [0, 2, 0]
mass = 5
inertia = [2, 2, 2]
orientation = { axis = [0, 0, 1], angle = 0 }
angular_velocity = [0, 0, 2]
[[effect]]
kind = "central_gravity"
center = "sun"
strength = 4
)",
                                 "wheel");
  EXPECT_LE(magnitude(Mpfr(seen_at_start(scene, {"force(wheel, y)"})[0] - 5)), 100 * epsilon<Mpfr>());
}

TEST_F(SupportForceTest, IsOfABodyThatIsHeld) {
  const Scene scene = load_scene("double_physical_pendulum");
  const auto refusal = [&](const std::string& text) {
    return message_of<InputError>([&] { seen_at_start(scene, {text}); });
  };
  expect_words(refusal("force(lower, x)"), {"'lower' is not 'fixed_at' a point"});
  expect_words(refusal("force(pivot, x)"), {"no rigid body 'pivot'", "upper"});
  expect_words(refusal("force(upper, w)"), {"'w' is no direction"});
}

}  // namespace
}  // namespace hbvm::core
