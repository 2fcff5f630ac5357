#include <Eigen/Geometry>

#include "printing.hpp"
#include "reference/taylor.hpp"
#include "scalar/text.hpp"
#include "scene/assembled.hpp"
#include "verification/models.hpp"

namespace hbvm::core {
namespace {

/// Numbers as an array of a scene.
std::string array_of(const Vector<Mpfr>& v) {
  std::string text;
  for (const Mpfr& x : v) text += (text.empty() ? "[\"" : ", \"") + to_text(x) + "\"";
  return text + "]";
}
std::string array_of(const Matrix<Mpfr>& a) {
  std::string text;
  for (Index i = 0; i < a.rows(); ++i) text += (i == 0 ? "[" : ", ") + array_of(Vector<Mpfr>(a.row(i).transpose()));
  return text + "]";
}

/// A free rigid body, in the plane or in space.
struct FreeBody {
  std::string name;
  Mpfr mass;
  Vector<Mpfr> center;
  Matrix<Mpfr> moment;  // second moment about the reference point
  Vector<Mpfr> position;
  Matrix<Mpfr> directors;  // a row each
  Vector<Mpfr> velocity, omega;

  /// Where what has these components in its frame is in space, and how that turns.
  Vector<Mpfr> in_space(const Vector<Mpfr>& v) const { return directors.transpose() * v; }
  Vector<Mpfr> turned(const Vector<Mpfr>& v) const {
    if (v.size() == 2) return Vector<Mpfr>{{Mpfr(-omega[0] * v[1]), Mpfr(omega[0] * v[0])}};
    return omega.head<3>().cross(v.head<3>());
  }
  /// Another that moves along, at this point of its frame with these directors there.
  FreeBody companion(std::string other, const Vector<Mpfr>& at, const Matrix<Mpfr>& turn) const {
    FreeBody result = *this;
    result.name = std::move(other);
    const Vector<Mpfr> way = in_space(at);
    result.position = position + way;
    result.velocity = velocity + turned(way);
    result.directors = turn * directors;
    return result;
  }
  std::string text() const {
    return "[[rigid_body]]\nname = \"" + name + "\"\nposition = " + array_of(position) +
           "\nvelocity = " + array_of(velocity) + "\nmass = \"" + to_text(mass) + "\"\ncenter = " + array_of(center) +
           "\nsecond_moment = " + array_of(moment) + "\ndirectors = " + array_of(directors) +
           "\nangular_velocity = " + (omega.size() == 1 ? "\"" + to_text(omega[0]) + "\"" : array_of(omega)) + "\n";
  }
};

std::string joint_of(const std::string& kind, const std::string& first, const std::string& second,
                     const std::string& keys = "") {
  return "[[constraint]]\nkind = \"" + kind + "\"\nbetween = [" + first + ", " + second + "]\n" + keys;
}
std::string point_of(const std::string& body, const std::string& at) {
  return "{ of = \"" + body + "\", at = [" + at + "] }";
}
std::string angle_of(const std::array<std::string, 4>& ends) {
  return "[[constraint]]\nkind = \"angle\"\nfirst = [" + ends[0] + ", " + ends[1] + "]\nsecond = [" + ends[2] + ", " +
         ends[3] + "]\nvalue = 0\n";
}
const std::string hook_in_space = "[[point]]\nname = \"hook\"\nposition = [1, 2, \"-1/2\"]\n",
                  pull_in_space = "[[effect]]\nkind = \"uniform_gravity\"\nacceleration = [\"1/3\", -1, \"1/2\"]\n",
                  hook_in_plane = "[[point]]\nname = \"hook\"\nposition = [1, 2]\n",
                  pull_in_plane = "[[effect]]\nkind = \"uniform_gravity\"\nacceleration = [\"1/3\", -1]\n";
std::string spring_at(const std::string& place) {
  return "[[effect]]\nkind = \"spring\"\nbetween = [\"hook\", " + place + "]\nstiffness = 3\n";
}

/// Mechanisms against others that move alike, to the round-off of 50 digits.
class JointsTest : public InDigits<50> {
 protected:
  struct Reached {
    Assembled<Mpfr> scene;
    Vector<Mpfr> q;
  };
  /// Where a scene is at t = 1, by its Taylor series.
  static Reached at_one(const std::string& text) {
    Reached result{assembled<Mpfr>(text), {}};
    TaylorMotion motion(result.scene.problem, result.scene.q0, result.scene.p0);
    motion.advance_to(Mpfr(1));
    result.q = motion.q();
    EXPECT_GE(distance(result.q, result.scene.q0), Mpfr(1) / 2) << "it stood still";
    return result;
  }
  static void expect_same(const Vector<Mpfr>& a, const Vector<Mpfr>& b, const std::string& what) {
    EXPECT_LE(distance(a, b), literal<Mpfr>("1e-44")) << what;
  }
  static Index degrees_of_freedom(const Reached& of) { return of.scene.problem.m() - of.scene.problem.nu(); }

  static FreeBody body_of_space() {
    return {"a",
            Mpfr(2),
            vector_of({"0", "1/10", "-1/5"}),
            matrix_of({{"1/2", "1/20", "0"}, {"1/20", "1/3", "1/30"}, {"0", "1/30", "1/4"}}),
            vector_of({"1/2", "0", "1/3"}),
            matrix_of({{"2/3", "2/3", "1/3"}, {"-2/3", "1/3", "2/3"}, {"1/3", "-2/3", "2/3"}}),
            vector_of({"1", "-1/2", "0"}),
            vector_of({"1", "-1/2", "2"})};
  }
  static FreeBody body_of_plane() {
    return {"a",
            Mpfr(2),
            vector_of({"1/10", "1/5"}),
            matrix_of({{"1/2", "1/20"}, {"1/20", "1/3"}}),
            vector_of({"1/2", "0"}),
            matrix_of({{"3/5", "4/5"}, {"-4/5", "3/5"}}),
            vector_of({"1", "-1/2"}),
            vector_of({"3/2"})};
  }
};

/// Without what rounding makes of it.
Matrix<Mpfr> symmetric(const Matrix<Mpfr>& a) { return (a + a.transpose()) / Mpfr(2); }

/// The second moment of both about the reference point of the first.
Matrix<Mpfr> joined_moment(const FreeBody& a, const FreeBody& b, const Vector<Mpfr>& at, const Matrix<Mpfr>& turn) {
  const Vector<Mpfr> center = turn.transpose() * b.center * b.mass;
  return symmetric(a.moment + at * at.transpose() * b.mass + at * center.transpose() + center * at.transpose() +
                   turn.transpose() * b.moment * turn);
}

/// Two bodies welded, askew, are one whose mass, centre and second moment are those of both.
TEST_F(JointsTest, WeldedBodiesAreOne) {
  for (const Index d : {2, 3}) {
    const bool plane = d == 2;
    FreeBody a = plane ? body_of_plane() : body_of_space();
    const Matrix<Mpfr> turn =
        plane ? matrix_of({{"5/13", "12/13"}, {"-12/13", "5/13"}})
              : matrix_of({{"6/7", "2/7", "-3/7"}, {"3/7", "-6/7", "2/7"}, {"-2/7", "-3/7", "-6/7"}});
    ASSERT_LE(distance<Mpfr>(turn.transpose() * turn.col(0), Vector<Mpfr>::Unit(d, 0)), 8 * epsilon<Mpfr>());
    // The point (1, 0, 0) of the first is (0, -1/2, 0) of the second.
    const Vector<Mpfr> at = Vector<Mpfr>::Unit(d, 0) + turn.transpose() * Vector<Mpfr>::Unit(d, 1) / Mpfr(2);
    FreeBody b = a.companion("b", at, turn);
    b.mass = 3;
    b.center = plane ? vector_of({"1/10", "-1/7"}) : vector_of({"1/10", "-1/7", "1/9"});
    b.moment = b.moment * Mpfr(2);
    const std::string head = "dimension = " + std::to_string(d) + "\n" + (plane ? hook_in_plane : hook_in_space),
                      pull = plane ? pull_in_plane : pull_in_space, zeros = plane ? "" : ", 0";
    const auto two = at_one(head + a.text() + b.text() +
                            joint_of("weld", point_of("a", "1, 0" + zeros), point_of("b", "0, \"-1/2\"" + zeros)) +
                            pull + spring_at(point_of("b", "0, 0" + zeros)));
    FreeBody one = a;
    one.mass = a.mass + b.mass;
    one.moment = joined_moment(a, b, at, turn);
    one.center = (a.center * a.mass + (at + turn.transpose() * b.center) * b.mass) / one.mass;
    std::string place;
    for (const Mpfr& x : at) place += (place.empty() ? "\"" : ", \"") + to_text(x) + "\"";
    const auto single = at_one(head + one.text() + pull + spring_at(point_of("a", place)));
    const Index size = d * (d + 1);
    EXPECT_EQ(degrees_of_freedom(two), plane ? 3 : 6);
    expect_same(two.q.head(size), single.q, "first body");
    Vector<Mpfr> r = single.q.head(d);
    for (Index i = 0; i < d; ++i) r += at[i] * single.q.segment(d * (i + 1), d);
    expect_same(two.q.segment(size, d), r, "second body");
    for (Index i = 0; i < d; ++i) {
      Vector<Mpfr> director = Vector<Mpfr>::Zero(d);
      for (Index j = 0; j < d; ++j) director += turn(i, j) * single.q.segment(d * (j + 1), d);
      expect_same(two.q.segment(size + d * (i + 1), d), director, "directors");
    }
  }
}

/// A slider turns with its rail. So it is a bead with its mass, and its moment of inertia about its centre of mass is
/// that of the rail. The bead is held on the line by the kind `angle`.
TEST_F(JointsTest, ASliderOnAPlaneRailIsABead) {
  FreeBody rail = body_of_plane();
  const Vector<Mpfr> n = vector_of({"4/5", "3/5"}), from = vector_of({"1/10", "1/4"});
  FreeBody slider =
      rail.companion("slider", from + n * (Mpfr(3) / 2), matrix_of({{"5/13", "12/13"}, {"-12/13", "5/13"}}));
  slider.velocity += rail.in_space(n) * (Mpfr(2) / 3);
  slider.center = vector_of({"0", "0"});
  slider.moment = matrix_of({{"1/8", "1/100"}, {"1/100", "1/20"}});
  slider.mass = Mpfr(5) / 3;
  const std::string head = "dimension = 2\n" + hook_in_plane, place = point_of("a", "\"1/10\", \"1/4\"");
  const auto with_slider = at_one(head + rail.text() + slider.text() +
                                  joint_of("prismatic", place, point_of("slider", "0, 0"), "axis = [4, 3]\n") +
                                  pull_in_plane + spring_at(point_of("slider", "0, 0")));
  rail.moment(0, 0) += slider.moment(0, 0) + slider.moment(1, 1);
  const auto with_bead =
      at_one(head + "[[body]]\nname = \"bead\"\nmass = \"" + to_text(slider.mass) +
             "\"\nposition = " + array_of(slider.position) + "\nvelocity = " + array_of(slider.velocity) + "\n" +
             rail.text() + angle_of({"\"bead\"", place, point_of("a", "-3, 4"), point_of("a", "0, 0")}) +
             pull_in_plane + spring_at("\"bead\""));
  EXPECT_EQ(degrees_of_freedom(with_slider), 4);
  EXPECT_EQ(degrees_of_freedom(with_bead), 4);
  expect_same(with_slider.q.head(6), with_bead.q.tail(6), "rail");
  expect_same(with_slider.q.segment(6, 2), with_bead.q.head(2), "slider");
}

/// A slider-crank. Its slider is on a rail in space, and does not turn. It is a bead on a `plane`, which is a line
/// here.
TEST_F(JointsTest, ASliderCrankHasABeadOnALine) {
  const std::string head = "dimension = 2\n[[point]]\nname = \"rail\"\nposition = [5, 0]\n", bars = R"([[rigid_body]]
name = "crank"
fixed_at = [0, 0]
mass = 1
center = ["1/2", 0]
inertia = "1/12"
orientation = { directors = [["3/5", "4/5"], ["-4/5", "3/5"]] }
angular_velocity = 2
[[rigid_body]]
name = "rod"
position = ["3/5", "4/5"]
velocity = ["-8/5", "6/5"]
mass = 1
center = ["17/20", 0]
inertia = "1/5"
orientation = { directors = [["15/17", "-8/17"], ["8/17", "15/17"]] }
angular_velocity = "-4/5"
)",
                    pins = joint_of("ball_joint", point_of("crank", "1, 0"), point_of("rod", "0, 0")),
                    start = "mass = 2\nposition = [\"21/10\", 0]\nvelocity = [\"-56/25\", 0]\n",
                    end = point_of("rod", "\"17/10\", 0");
  const std::string with_slider = head + bars + "[[rigid_body]]\nname = \"slider\"\n" + start +
                                  "inertia = 1\norientation = 1\nangular_velocity = 0\n" + pins +
                                  joint_of("ball_joint", end, point_of("slider", "0, 0")) +
                                  joint_of("prismatic", "\"rail\"", point_of("slider", "0, 0"), "axis = [1, 0]\n") +
                                  pull_in_plane,
                    with_bead = head + "[[body]]\nname = \"bead\"\n" + start + bars + pins +
                                joint_of("ball_joint", end, "\"bead\"") +
                                "[[constraint]]\nkind = \"plane\"\nbody = \"bead\"\nnormal = [0, 1]\noffset = 0\n" +
                                pull_in_plane;
  const auto sliding = at_one(with_slider), beaded = at_one(with_bead);
  EXPECT_EQ(degrees_of_freedom(sliding), 1);
  EXPECT_EQ(degrees_of_freedom(beaded), 1);
  expect_same(sliding.q.head(10), beaded.q.tail(10), "crank and rod");
  expect_same(sliding.q.segment(10, 2), beaded.q.head(2), "slider");
  expect_same(sliding.q.tail(4), sliding.scene.q0.tail(4), "directors of the slider");
  // What holds the slider up: l1 e, with e upwards, and -l n of the plane.
  const auto held = [](const Reached& of, Index from_the_end) {
    StateEvaluator<Mpfr> point(of.scene.problem);
    const Vector<Mpfr> lambda = point.multiplier(of.scene.q0, of.scene.p0);
    return Mpfr(lambda[lambda.size() - from_the_end]);
  };
  EXPECT_LE(magnitude(Mpfr(held(sliding, 2) + held(beaded, 1))), literal<Mpfr>("1e-44"));
  EXPECT_GE(magnitude(held(sliding, 2)), Mpfr(1) / 10);
}

TEST_F(JointsTest, ASliderOnARailOfSpaceIsABead) {
  FreeBody rail = body_of_space();
  const Vector<Mpfr> n = vector_of({"1/3", "2/3", "2/3"}), from = vector_of({"1/10", "1/4", "-1/5"});
  const Matrix<Mpfr> turn = matrix_of({{"6/7", "2/7", "-3/7"}, {"3/7", "-6/7", "2/7"}, {"-2/7", "-3/7", "-6/7"}});
  FreeBody slider = rail.companion("slider", from + n * (Mpfr(3) / 2), turn);
  slider.velocity += rail.in_space(n) * (Mpfr(2) / 3);
  slider.center = vector_of({"0", "0", "0"});
  slider.moment = matrix_of({{"1/8", "1/100", "0"}, {"1/100", "1/20", "1/50"}, {"0", "1/50", "1/10"}});
  slider.mass = Mpfr(5) / 3;
  const std::string head = "dimension = 3\n" + hook_in_space, place = point_of("a", "\"1/10\", \"1/4\", \"-1/5\"");
  const auto with_slider = at_one(head + rail.text() + slider.text() +
                                  joint_of("prismatic", place, point_of("slider", "0, 0, 0"), "axis = [2, 4, 4]\n") +
                                  pull_in_space + spring_at(point_of("slider", "0, 0, 0")));
  rail.moment += symmetric(turn.transpose() * slider.moment * turn);
  const std::string middle = point_of("a", "0, 0, 0");
  const auto with_bead =
      at_one(head + "[[body]]\nname = \"bead\"\nmass = \"" + to_text(slider.mass) +
             "\"\nposition = " + array_of(slider.position) + "\nvelocity = " + array_of(slider.velocity) + "\n" +
             rail.text() + angle_of({"\"bead\"", place, point_of("a", "0, 1, -1"), middle}) +
             angle_of({"\"bead\"", place, point_of("a", "-4, 1, 1"), middle}) + pull_in_space + spring_at("\"bead\""));
  EXPECT_EQ(degrees_of_freedom(with_slider), 7);
  EXPECT_EQ(degrees_of_freedom(with_bead), 7);
  expect_same(with_slider.q.head(12), with_bead.q.tail(12), "rail");
  expect_same(with_slider.q.segment(12, 3), with_bead.q.head(3), "slider");
}

/// Two points of a sleeve are on the line of a shaft, each by two of the kind `angle`.
TEST_F(JointsTest, ASleeveHasTwoPointsOnItsShaft) {
  const FreeBody shaft = body_of_space();
  const Vector<Mpfr> n = vector_of({"1/3", "2/3", "2/3"}), from = vector_of({"1/10", "1/4", "-1/5"});
  // Its (2, 3, 6)/7 is along n, its reference point (0, 1/2, 0) aside.
  const Matrix<Mpfr> along = matrix_of({{"2/3", "1/3", "-2/3"}, {"-2/3", "2/3", "-1/3"}, {"1/3", "2/3", "2/3"}}),
                     its = matrix_of({{"-6/7", "-2/7", "3/7"}, {"3/7", "-6/7", "2/7"}, {"2/7", "3/7", "6/7"}}),
                     turn = its.transpose() * along;
  const Vector<Mpfr> aside = turn.transpose() * vector_of({"0", "-1/2", "0"});
  FreeBody sleeve = shaft.companion("sleeve", from + n * (Mpfr(3) / 2) + aside, turn);
  const Vector<Mpfr> axis = shaft.in_space(n), spin = axis * (Mpfr(5) / 4);
  sleeve.omega += spin;
  sleeve.velocity += axis * (Mpfr(2) / 3) + Vector<Mpfr>(spin.head<3>().cross(shaft.in_space(aside).head<3>()));
  sleeve.mass = Mpfr(5) / 3;
  const std::string head = "dimension = 3\n" + hook_in_space + shaft.text() + sleeve.text(),
                    tail = pull_in_space + spring_at(point_of("sleeve", "0, 0, 1")),
                    place = point_of("a", "\"1/10\", \"1/4\", \"-1/5\""), first = point_of("sleeve", "0, \"1/2\", 0"),
                    second = point_of("sleeve", "2, \"7/2\", 6"), middle = point_of("a", "0, 0, 0");
  const auto joined =
      at_one(head + joint_of("cylindrical", first, place, "axis = [2, 3, 6]\nsecond_axis = [2, 4, 4]\n") + tail);
  std::string angles;
  for (const std::string& point : {first, second})
    for (const char* const across : {"0, 1, -1", "-4, 1, 1"})
      angles += angle_of({point, place, point_of("a", across), middle});
  const auto by_points = at_one(head + angles + tail);
  EXPECT_EQ(degrees_of_freedom(joined), 8);
  EXPECT_EQ(degrees_of_freedom(by_points), 8);
  expect_same(joined.q, by_points.q, "shaft and sleeve");
}

/// What the page says of the force and torque of each joint's multipliers. Newton's and Euler's laws hold for both
/// bodies with them, by accelerations that come from the coordinates.
class JointForces : public JointsTest {
 protected:
  struct Wrench {
    Vector<Mpfr> at, force, torque;
  };
  static Vector<Mpfr> cross(const Vector<Mpfr>& a, const Vector<Mpfr>& b) { return a.head<3>().cross(b.head<3>()); }

  /// The first body, the second, and the joint between their points p and r, at rest at those of the start.
  static void expect_newton(const std::string& kind, const std::string& keys, const Vector<Mpfr>& p,
                            const FreeBody& second, const Vector<Mpfr>& r) {
    const FreeBody first = body_of_space();
    const auto name = [&](const std::string& body, const Vector<Mpfr>& at) {
      const std::string text = array_of(at);
      return point_of(body, text.substr(1, text.size() - 2));
    };
    const auto scene = assembled<Mpfr>("dimension = 3\n" + hook_in_space + first.text() + second.text() +
                                       joint_of(kind, name("a", p), name("b", r), keys) + pull_in_space +
                                       spring_at(point_of("a", "1, 0, 2")) + spring_at(point_of("b", "0, 1, 1")));
    const Problem<Mpfr>& problem = scene.problem;
    StateEvaluator<Mpfr> point(problem);
    const Vector<Mpfr> lambda = point.multiplier(scene.q0, scene.p0);
    const auto forces = point.forces(scene.q0, scene.p0);
    const Vector<Mpfr> rate = forces.applied + forces.constraint;
    Vector<Mpfr> acceleration(24);
    problem.mass.velocity(lanes(rate), lanes(acceleration));
    const Wrench joint = on_first(kind, Vector<Mpfr>(lambda.tail(lambda.size() - 12)), first, p, second, r);
    for (const bool of_first : {true, false}) {
      const FreeBody& body = of_first ? first : second;
      const Vector<Mpfr> its = acceleration.segment(of_first ? 0 : 12, 12),
                         center = body.position + body.in_space(body.center);
      Vector<Mpfr> motion = its.head(3), turning = Vector<Mpfr>::Zero(3);
      for (Index i = 0; i < 3; ++i) {
        motion += body.center[i] * its.segment(3 * (i + 1), 3);
        for (Index j = 0; j < 3; ++j)
          turning += Mpfr(body.moment(i, j) - body.mass * body.center[i] * body.center[j]) *
                     cross(body.directors.row(i).transpose(), its.segment(3 * (j + 1), 3));
      }
      const Vector<Mpfr> end =
          body.position + body.in_space(of_first ? vector_of({"1", "0", "2"}) : vector_of({"0", "1", "1"}));
      const Vector<Mpfr> spring = (vector_of({"1", "2", "-1/2"}) - end) * Mpfr(3);
      const Mpfr sign = of_first ? 1 : -1;
      expect_same(motion * body.mass, vector_of({"1/3", "-1", "1/2"}) * body.mass + spring + joint.force * sign,
                  kind + ", force");
      expect_same(turning,
                  Vector<Mpfr>(cross(end - center, spring) + cross(joint.at - center, joint.force) * sign +
                               joint.torque * sign),
                  kind + ", torque");
    }
  }

  /// As the table of the page says it.
  static Wrench on_first(const std::string& kind, const Vector<Mpfr>& lambda, const FreeBody& first,
                         const Vector<Mpfr>& p, const FreeBody& second, const Vector<Mpfr>& r) {
    const Vector<Mpfr> q_a = first.position + first.in_space(p), q_b = second.position + second.in_space(r);
    const auto director = [&](Index i) { return Vector<Mpfr>(second.directors.row(i).transpose()); };
    const Vector<Mpfr> none = Vector<Mpfr>::Zero(3);
    if (kind == "weld")
      return {q_a, -lambda.head(3), -director(0) * lambda[3] - director(1) * lambda[4] - director(2) * lambda[5]};
    // Of the axis (1, 2, -2)/3 the first component is the least: e is x less its share along n, over its length.
    const Vector<Mpfr> n = vector_of({"1", "2", "-2"}) / Mpfr(3),
                       e = (vector_of({"1", "0", "0"}) - n / Mpfr(3)) / Mpfr(sqrt(Mpfr(8) / 9)), f = cross(n, e);
    const Vector<Mpfr> e_a = first.in_space(e), f_a = first.in_space(f), e_b = second.in_space(e),
                       f_b = second.in_space(f);
    if (kind == "hinge") return {q_a, -lambda.head(3), e_b * lambda[4] - f_b * lambda[3]};
    if (kind == "cylindrical") return {q_a, -e_b * lambda[0] - f_b * lambda[1], e_b * lambda[3] - f_b * lambda[2]};
    if (kind == "prismatic")
      return {q_b, -e_a * lambda[0] - f_a * lambda[1],
              -director(0) * lambda[2] - director(1) * lambda[3] - director(2) * lambda[4]};
    return {q_a, -lambda.head(3),
            -cross(first.in_space(n), second.in_space(vector_of({"0", "3/5", "4/5"}))) * lambda[3]};
  }
};

TEST_F(JointForces, AreThoseOfThePage) {
  const FreeBody a = body_of_space();
  const Vector<Mpfr> n = vector_of({"1", "2", "-2"}) / Mpfr(3), p = vector_of({"1/5", "-1", "1/2"}),
                     r = vector_of({"1/4", "1/3", "-1"});
  const Matrix<Mpfr> turn = matrix_of({{"6/7", "2/7", "-3/7"}, {"3/7", "-6/7", "2/7"}, {"-2/7", "-3/7", "-6/7"}});
  const auto with_point_at = [&](const Vector<Mpfr>& at, const Matrix<Mpfr>& its) {
    FreeBody b = a.companion("b", at - its.transpose() * r, its);
    b.mass = 3;
    return b;
  };
  expect_newton("weld", "", p, with_point_at(p, turn), r);
  const Vector<Mpfr> shifted = p + n * (Mpfr(3) / 4);
  FreeBody slider = with_point_at(shifted, turn);
  slider.velocity += a.in_space(n) * (Mpfr(1) / 2);
  expect_newton("prismatic", "axis = [1, 2, -2]\n", p, slider, r);
  // Turned about the axis, which both have at the same place of their frames; and turning about it.
  const Mpfr c = Mpfr(3) / 5, s = Mpfr(4) / 5;
  Matrix<Mpfr> about(3, 3);
  for (Index i = 0; i < 3; ++i) {
    const Vector<Mpfr> unit = Vector<Mpfr>::Unit(3, i);
    about.row(i) = (unit * c + cross(n, unit) * s + n * Mpfr(n[i] * (1 - c))).transpose();
  }
  const auto spinning = [&](FreeBody b) {
    const Vector<Mpfr> spin = a.in_space(n) * (Mpfr(5) / 4);
    b.velocity -= cross(spin, b.in_space(r));
    b.omega += spin;
    return b;
  };
  expect_newton("hinge", "axis = [1, 2, -2]\n", p, spinning(with_point_at(p, about)), r);
  FreeBody sleeve = spinning(with_point_at(shifted, about));
  sleeve.velocity += a.in_space(n) * (Mpfr(1) / 2);
  expect_newton("cylindrical", "axis = [1, 2, -2]\n", p, sleeve, r);
  // The second axis is (0, 3/5, 4/5) of a body that is turned as its third director is along n.
  const Matrix<Mpfr> along = matrix_of({{"2/3", "1/3", "2/3"}, {"-2/3", "2/3", "1/3"}, {"-1/3", "-2/3", "2/3"}}),
                     cross_of = matrix_of({{"0", "3/5", "4/5"}, {"1", "0", "0"}, {"0", "4/5", "-3/5"}});
  expect_newton("universal", "axis = [1, 2, -2]\nsecond_axis = [0, 3, 4]\n", p,
                with_point_at(p, cross_of.transpose() * along), r);
}

/// Two shafts at an angle with the cosine c, both turning in bearings. The angle a of the first is 0 where its fork is
/// across both. The second is at b with tan b = c tan a, so that b' = c a' / (cos^2 a + c^2 sin^2 a). Their energy is
/// constant, so that the time of a turn is an integral.
TEST_F(JointsTest, ShaftsTurnAsCardanSays) {
  const auto shaft = [](const std::string& name, const char* at, const char* directors, const char* moment,
                        const char* omega) {
    return "[[rigid_body]]\nname = \"" + name + "\"\nposition = " + at + "\nvelocity = [0, 0, 0]\nmass = 1\n" +
           "center = [0, 0, 0]\nsecond_moment = " + moment + "\ndirectors = " + directors +
           "\nangular_velocity = " + omega + "\n";
  };
  const auto scene = assembled<Mpfr>(
      "dimension = 3\n[[point]]\nname = \"P\"\nposition = [0, 0, \"-3/2\"]\n[[point]]\nname = \"Q\"\nposition = [0, "
      "\"9/10\", \"6/5\"]\n" +
      shaft("first", "[0, 0, -1]", "[[-1, 0, 0], [0, -1, 0], [0, 0, 1]]",
            "[[\"1/3\", 0, 0], [0, \"1/5\", 0], [0, 0, 1]]", "[0, 0, \"5/2\"]") +
      shaft("second", "[0, \"3/5\", \"4/5\"]", "[[0, \"-4/5\", \"3/5\"], [1, 0, 0], [0, \"3/5\", \"4/5\"]]",
            "[[\"1/2\", 0, 0], [0, \"1/4\", 0], [0, 0, 1]]", "[0, \"6/5\", \"8/5\"]") +
      joint_of("hinge", "\"P\"", point_of("first", "0, 0, \"-1/2\""), "axis = [0, 0, 1]\n") +
      joint_of("universal", point_of("first", "0, 0, 1"), point_of("second", "0, 0, -1"),
               "axis = [2, 0, 0]\nsecond_axis = [3, 0, 0]\n") +
      joint_of("hinge", "\"Q\"", point_of("second", "0, 0, \"1/2\""), "axis = [0, 3, 4]\nsecond_axis = [0, 0, 1]\n"));
  EXPECT_EQ(scene.problem.m() - scene.problem.nu(), 1);
  EXPECT_EQ(scene.problem.redundant.size(), 3u);
  const Mpfr c = Mpfr(4) / 5, pi = acos(Mpfr(-1)), I1 = literal<Mpfr>("1/3 + 1/5"), I2 = literal<Mpfr>("1/2 + 1/4");
  const auto ratio = [&](const Mpfr& a) {
    const Mpfr x = cos(a), y = c * sin(a);
    return Mpfr(c / (x * x + y * y));
  };
  const Mpfr energy = (I1 + I2 * c * c) * 25 / 8;
  // An analytic function over its period: the sum has as many digits as points, and more.
  constexpr int points = 512;
  Mpfr turn = 0;
  for (int i = 0; i < points; ++i) {
    const Mpfr r = ratio(2 * pi * i / points);
    turn += sqrt(Mpfr((I1 + I2 * r * r) / (2 * energy))) * 2 * pi / points;
  }
  TaylorMotion motion(scene.problem, scene.q0, scene.p0);
  for (const int thirds : {1, 2, 3}) {
    motion.advance_to(turn * thirds / 3);
    const Vector<Mpfr>& q = motion.q();
    const Mpfr a = atan2(Mpfr(-q[4]), Mpfr(-q[3])), b = atan2(q[15], Mpfr(-Mpfr(4) / 5 * q[16] + Mpfr(3) / 5 * q[17]));
    EXPECT_LE(magnitude(Mpfr(cos(a) * sin(b) - c * sin(a) * cos(b))), literal<Mpfr>("1e-44")) << thirds;
    EXPECT_EQ(magnitude(a) >= Mpfr(1) / 2, thirds < 3);
  }
  EXPECT_LE(distance(motion.q(), scene.q0), literal<Mpfr>("1e-43"));
}

/// A wheel of the plane that turns about its centre of mass, or in space about d3 through a hinge.
std::string wheel_at(const std::string& name, const std::string& at, const std::string& inertia,
                     const std::string& angle, const std::string& omega) {
  return "[[rigid_body]]\nname = \"" + name + "\"\nfixed_at = " + at +
         "\nmass = 1\ncenter = [\"1/5\", 0]\ninertia = " + inertia + "\norientation = " + angle +
         "\nangular_velocity = " + omega + "\n";
}
std::string gear_of(const std::string& a, const std::string& b, const std::string& at, const std::string& keys = "") {
  return joint_of("gear", point_of("one", at), point_of("two", at),
                  "first_teeth = " + a + "\nsecond_teeth = " + b + "\n" + keys);
}

/// Wheels with 24 and -36 teeth, one inside the other, turn the same way by 2 a = 3 b. Each has a weight aside. By the
/// angle x of the first there is Lagrange's equation, which is solved by its energy: x'^2 (I + 4/9 J)/2 + V(x) is
/// constant. The time to an angle is an integral, by Simpson's rule and its Richardson extrapolations.
TEST_F(JointsTest, GearsTurnByTheirTeeth) {
  for (const int way : {1, -1}) {
    const auto scene = assembled<Mpfr>("dimension = 2\n" + wheel_at("one", "[0, 0]", "\"1/3\"", "\"1/3\"", "\"3/2\"") +
                                       wheel_at("two", "[1, 2]", "\"1/2\"", "2", way > 0 ? "1" : "-1") +
                                       gear_of("24", way > 0 ? "-36" : "36", "0, 0") +
                                       "[[effect]]\nkind = \"uniform_gravity\"\nacceleration = [0, -1]\n");
    EXPECT_EQ(scene.problem.m() - scene.problem.nu(), 1);
    EXPECT_EQ(scene.problem.constraints.back().name, "gear 'one[0, 0]'-'two[0, 0]'");
    EXPECT_EQ(degree(scene.problem.constraints), 5);
    TaylorMotion motion(scene.problem, scene.q0, scene.p0);
    motion.advance_to(Mpfr(1));
    const Vector<Mpfr>& q = motion.q();
    const Mpfr x0 = Mpfr(1) / 3, x = atan2(q[1], q[0]), y = 2 + Mpfr(2 * way) * (x - x0) / 3;
    EXPECT_GE(x - x0, Mpfr(1));
    EXPECT_LE(magnitude(Mpfr(q[4] - cos(y))), literal<Mpfr>("1e-44"));
    EXPECT_LE(magnitude(Mpfr(q[5] - sin(y))), literal<Mpfr>("1e-44"));
    const Mpfr inertia = literal<Mpfr>("1/3 + 1/25") + literal<Mpfr>("1/2 + 1/25") * 4 / 9;
    const auto V = [&](const Mpfr& angle) {
      return Mpfr((sin(angle) + sin(Mpfr(2 + Mpfr(2 * way) * (angle - x0) / 3))) / 5);
    };
    const Mpfr energy = inertia * 9 / 8 + V(x0);
    const auto slowness = [&](const Mpfr& angle) { return Mpfr(sqrt(Mpfr(inertia / (2 * (energy - V(angle)))))); };
    // Romberg's rule.
    constexpr std::size_t rows = 15;
    std::vector<Mpfr> row{Mpfr((x - x0) * (slowness(x0) + slowness(x)) / 2)};
    for (std::size_t k = 1; k < rows; ++k) {
      const long parts = 1L << (k - 1);
      const Mpfr h = (x - x0) / parts;
      Mpfr sum = 0;
      for (long i = 0; i < parts; ++i) sum += slowness(Mpfr(x0 + h * (2 * i + 1) / 2));
      std::vector<Mpfr> next{Mpfr((row[0] + h * sum) / 2)};
      Mpfr power = 1;
      for (std::size_t j = 1; j <= k; ++j) {
        power *= 4;
        next.push_back((power * next[j - 1] - row[j - 1]) / (power - 1));
      }
      row = next;
    }
    EXPECT_LE(magnitude(Mpfr(row.back() - 1)), literal<Mpfr>("1e-44")) << way;
  }
}

/// Bevel gears, about axes across one another: the multiplier is a torque about both, by the teeth.
TEST_F(JointsTest, BevelGearsShareTheirTorque) {
  const auto wheel = [](const std::string& name, const std::string& axis, const std::string& omega) {
    return "[[rigid_body]]\nname = \"" + name +
           "\"\nfixed_at = [0, 0, 0]\nmass = 1\ncenter = [0, 0, 0]\ninertia = [2, 2, 2]\norientation = { axis = " +
           axis + ", angle = \"pi/2\" }\nangular_velocity = " + omega + "\n" +
           "[[constraint]]\nkind = \"hinge\"\nbetween = [\"o\", { of = \"" + name + "\", at = [0, 0, 0] }]\naxis = ";
  };
  // d3 of the first is x, of the second -y.
  const std::string text =
      "dimension = 3\n[[point]]\nname = \"o\"\nposition = [0, 0, 0]\n[[point]]\nname = \"far\"\nposition = [0, 0, "
      "5]\n" +
      wheel("one", "[0, 1, 0]", "[3, 0, 0]") + "[1, 0, 0]\nsecond_axis = [0, 0, 1]\n" +
      wheel("two", "[1, 0, 0]", "[0, 1, 0]") + "[0, -1, 0]\nsecond_axis = [0, 0, 1]\n" +
      gear_of("10", "30", "0, 0, 0", "axis = [0, 0, 4]\n") +
      "[[effect]]\nkind = \"spring\"\nstiffness = 1\nbetween = [\"far\", { of = \"one\", at = [0, 1, 0] }]\n";
  const auto scene = assembled<Mpfr>(text);
  EXPECT_EQ(scene.problem.m() - scene.problem.nu(), 1);
  StateEvaluator<Mpfr> point(scene.problem);
  const Vector<Mpfr> lambda = point.multiplier(scene.q0, scene.p0);
  // The spring's torque about x is that of the force 5 along z at (0, 1, 0): 5 = (2 + 2/9) a'' of the first.
  const Mpfr rate = Mpfr(5) / (2 + Mpfr(2) / 9);
  EXPECT_LE(magnitude(Mpfr(lambda[lambda.size() - 1] - (5 - 2 * rate))), literal<Mpfr>("1e-44"));
  TaylorMotion motion(scene.problem, scene.q0, scene.p0);
  motion.advance_to(Mpfr(1));
  const Vector<Mpfr>& q = motion.q();
  // Of each d1 and d2: the angles turned about x and -y.
  const Mpfr first = atan2(Mpfr(q[1]), Mpfr(-q[2])), second = atan2(Mpfr(q[11]), Mpfr(q[9]));
  EXPECT_GE(magnitude(second), Mpfr(1) / 2);
  EXPECT_LE(magnitude(Mpfr(sin(Mpfr(first + 3 * second)))), literal<Mpfr>("1e-44"));
}

}  // namespace
}  // namespace hbvm::core
