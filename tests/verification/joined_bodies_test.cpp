#include "scene/joined_bodies.hpp"

#include "integrate/drift.hpp"
#include "integrate/momentum_drift.hpp"
#include "integrate/output_state.hpp"
#include "integrate/runs.hpp"
#include "printing.hpp"
#include "scene/scene_text.hpp"
#include "step/stepping.hpp"
#include "verification/second_route.hpp"

namespace hbvm::core {
namespace {

Mpfr number(const char* text) { return literal<Mpfr>(text); }

/// Coordinates and velocities of rigid bodies, put together point by point from angles and their rates.
struct Motion {
  std::vector<Mpfr> q, v;

  void add(const Vector<Mpfr>& at, const Vector<Mpfr>& rate) {
    q.insert(q.end(), at.begin(), at.end());
    v.insert(v.end(), rate.begin(), rate.end());
  }
  Vector<Mpfr> positions() const { return Eigen::Map<const Vector<Mpfr>>(q.data(), static_cast<Index>(q.size())); }
  Vector<Mpfr> velocities() const { return Eigen::Map<const Vector<Mpfr>>(v.data(), static_cast<Index>(v.size())); }
};

/// A planar body whose d1 stands at an angle to the x axis.
struct Bar {
  Mpfr angle, rate;

  Vector<Mpfr> along() const { return Vector<Mpfr>{{cos(angle), sin(angle)}}; }
  Vector<Mpfr> across() const { return Vector<Mpfr>{{Mpfr(-sin(angle)), cos(angle)}}; }
  /// x d1 + y d2, and how it turns with the angle.
  Vector<Mpfr> arm(const Mpfr& x, const Mpfr& y) const { return along() * x + across() * y; }
  Vector<Mpfr> turn(const Mpfr& x, const Mpfr& y) const { return across() * x - along() * y; }
  void add_directors(Motion& motion) const {
    motion.add(along(), across() * rate);
    motion.add(across(), along() * Mpfr(-rate));
  }
};

/// The scene double_physical_pendulum: Lagrange's equations for the angles of both bars.
///
///     (I1 + m2 l^2) x'' + m2 l c2 (cos(x - y) y'' + sin(x - y) y'^2) = -g (m1 c1 + m2 l) cos x
///     (I2 + m2 c2^2) y'' + m2 l c2 (cos(x - y) x'' - sin(x - y) x'^2) = -g m2 c2 cos y
struct DoublePhysicalPendulum {
  // m1 = 2, c1 = 1/2, l = 1, I1 = 2/3 + 1/150; m2 = 1, c2 = 2/5, I2 = 16/300 + 1/1200; g = 1
  const Mpfr I1 = number("2/3 + 1/150"), I2 = number("16/300 + 1/1200"), c2 = number("2/5");

  void operator()(const OdeState& x, OdeState& rate) const {
    const Mpfr c = cos(Mpfr(x[0] - x[1])), s = sin(Mpfr(x[0] - x[1]));
    const Mpfr a11 = I1 + 1, a12 = c2 * c, a22 = I2 + c2 * c2;
    const Mpfr r1 = -c2 * s * x[3] * x[3] - 2 * cos(x[0]), r2 = c2 * s * x[2] * x[2] - c2 * cos(x[1]);
    const Mpfr determinant = a11 * a22 - a12 * a12;
    rate[0] = x[2];
    rate[1] = x[3];
    rate[2] = (a22 * r1 - a12 * r2) / determinant;
    rate[3] = (a11 * r2 - a12 * r1) / determinant;
  }

  std::array<Bar, 2> at(const Mpfr& T, int steps) const {
    const OdeState start{atan2(Mpfr(-4), Mpfr(3)), atan2(Mpfr(-5), Mpfr(12)), Mpfr(1) / 2, Mpfr(-1)};
    const OdeState x = second_route(*this, start, T, steps);
    return {Bar{x[0], x[2]}, Bar{x[1], x[3]}};
  }
  /// In the plane: the directors of the upper bar, whose end is fixed, the centre of the lower and its directors.
  Motion motion(const Mpfr& T, int steps) const {
    const auto [upper, lower] = at(T, steps);
    Motion result;
    upper.add_directors(result);
    result.add(upper.along() + lower.along() * c2,
               upper.across() * upper.rate + lower.across() * Mpfr(c2 * lower.rate));
    lower.add_directors(result);
    return result;
  }
};

/// The scene four_bar_linkage_of_bars by its one angle. H = M(x) x'^2/2 + V(x) is constant, so that the time from one
/// angle to another is an integral, of sqrt(M/(2 (H - V))).
struct FourBarOfBars {
  struct Position {
    Bar crank, coupler, rocker;  // with the rates for x' = 1
    Mpfr M, V;
  };
  const Vector<Mpfr> right{{number("2.3"), Mpfr(0)}}, ceiling{{Mpfr(1), Mpfr(4)}};
  // Of crank and rocker about their fixed ends, of the coupler about its centre of mass.
  const Mpfr crank_inertia = number("1/3 + 1/300"), rocker_inertia = number("25/6 + 1/50"),
             coupler_inertia = number("6 + 1/4 - 2*(9/4 + 1/16)");

  Position at(const Mpfr& angle) const {
    const Bar crank{angle, Mpfr(1)};
    // The triangle of the coupler, 3, the rocker, 5/2, and what is between their far ends.
    const Vector<Mpfr> a = crank.along(), between = right - a;
    const Mpfr r2 = between.dot(between), r = sqrt(r2);
    Bar coupler{atan2(between[1], between[0]) + acos(Mpfr((9 + r2 - Mpfr(25) / 4) / (6 * r))), Mpfr(0)};
    const Vector<Mpfr> b = a + coupler.along() * Mpfr(3);
    Bar rocker{atan2(Mpfr(b[1]), Mpfr(b[0] - right[0])), Mpfr(0)};
    // a' + 3 y' across(coupler) = 5/2 z' across(rocker), taken along each of the two.
    coupler.rate = -crank.across().dot(rocker.along()) / (3 * coupler.across().dot(rocker.along()));
    rocker.rate = 2 * crank.across().dot(coupler.along()) / (5 * rocker.across().dot(coupler.along()));
    const Mpfr x = Mpfr(3) / 2, y = Mpfr(1) / 4;  // the coupler's centre of mass
    const Vector<Mpfr> velocity = crank.across() + coupler.turn(x, y) * coupler.rate;
    Position result{crank, coupler, rocker, Mpfr(0), Mpfr(0)};
    result.M = crank_inertia + 2 * velocity.dot(velocity) + coupler_inertia * coupler.rate * coupler.rate +
               rocker_inertia * rocker.rate * rocker.rate;
    const Vector<Mpfr> stretch = a + coupler.arm(x, Mpfr(3) / 4) - ceiling;
    result.V = a[1] / 2 + 2 * Vector<Mpfr>(a + coupler.arm(x, y))[1] + 5 * rocker.along()[1] / 2 +
               3 * stretch.dot(stretch) / 4;
    return result;
  }
  const Mpfr first = atan2(Mpfr(3), Mpfr(-4));
  Mpfr energy() const {
    const Position start = at(first);
    return start.M * 9 / 8 + start.V;
  }
  /// The time of the motion from the start to an angle below, dt/dx by odeint as if x were the time.
  Mpfr time_to(const Mpfr& angle, int steps) const {
    const Mpfr H = energy();
    const auto f = [&](const OdeState& x, OdeState& rate) {
      const Position here = at(Mpfr(first - x[0]));
      rate[0] = 1;
      rate[1] = sqrt(Mpfr(here.M / (2 * (H - here.V))));
    };
    return second_route(f, {Mpfr(0), Mpfr(0)}, Mpfr(first - angle), steps)[1];
  }
  /// Directors of the crank; end of the crank and directors of the coupler; directors of the rocker.
  Motion motion(const Mpfr& angle) const {
    Position here = at(angle);
    const Mpfr rate = -sqrt(Mpfr(2 * (energy() - here.V) / here.M));
    for (Bar* bar : {&here.crank, &here.coupler, &here.rocker}) bar->rate *= rate;
    Motion result;
    here.crank.add_directors(result);
    result.add(here.crank.along(), here.crank.across() * here.crank.rate);
    here.coupler.add_directors(result);
    here.rocker.add_directors(result);
    return result;
  }
};

/// The scene gyroscope_on_gimbal by Euler's angles. They are f of the outer ring about z, x of the inner one about its
/// d1, y of the rotor about d3. p_f and p_y are constant:
///
///     A x'' = (B'(x) f'^2)/2 - p_y f' sin x + m g l sin x,   f' = (p_f - p_y cos x)/B(x),   y' = p_y/C - f' cos x
struct GyroscopeOnGimbal {
  const Mpfr l = number("1/5"), outer = number("1/8 + 1/100"), A = number("1/400 + 1/25 + 9/200 + 1/600 + 2/25"),
             across = number("2/25 + 9/200 + 1/600 + 2/25"), along = number("1/25 + 1/400"), C = number("9/100");
  const Mpfr x0 = atan2(Mpfr(3), Mpfr(4)), f0 = atan2(Mpfr(4), Mpfr(3));

  Mpfr B(const Mpfr& x) const {
    const Mpfr s = sin(x), c = cos(x);
    return outer + across * s * s + along * c * c;
  }
  const Mpfr p_y = C * (5 - cos(x0) / 2), p_f = p_y * cos(x0) - B(x0) / 2;

  /// x, f, y, x'.
  void operator()(const OdeState& x, OdeState& rate) const {
    const Mpfr s = sin(x[0]), c = cos(x[0]), turn = (p_f - p_y * c) / B(x[0]);
    rate[0] = x[3];
    rate[1] = turn;
    rate[2] = p_y / C - turn * c;
    rate[3] = ((across - along) * s * c * turn * turn - p_y * turn * s + 2 * l * s) / A;
  }

  using Frame = std::array<Vector<Mpfr>, 3>;
  static Vector<Mpfr> cross(const Vector<Mpfr>& a, const Vector<Mpfr>& b) {
    return Vector<Mpfr>{
        {Mpfr(a[1] * b[2] - a[2] * b[1]), Mpfr(a[2] * b[0] - a[0] * b[2]), Mpfr(a[0] * b[1] - a[1] * b[0])}};
  }
  /// A frame turned about its axis number k.
  static Frame turned(const Frame& frame, std::size_t k, const Mpfr& angle) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    Frame result = frame;
    result[i] = frame[i] * cos(angle) + frame[j] * sin(angle);
    result[j] = frame[j] * cos(angle) - frame[i] * sin(angle);
    return result;
  }
  Motion motion(const Mpfr& T, int steps) const {
    const OdeState x = second_route(*this, {x0, f0, Mpfr(0), Mpfr(1) / 4}, T, steps);
    OdeState rate(4);
    (*this)(x, rate);
    Frame space;
    for (Index i = 0; i < 3; ++i) space[static_cast<std::size_t>(i)] = Vector<Mpfr>::Unit(3, i);
    const Frame ring = turned(space, 2, x[1]), tilted = turned(ring, 0, x[0]), rotor = turned(tilted, 2, x[2]);
    const Vector<Mpfr> w_ring = space[2] * rate[1], w_tilted = w_ring + ring[0] * rate[0],
                       w_rotor = w_tilted + tilted[2] * rate[2];
    Motion result;
    for (const Vector<Mpfr>& d : ring) result.add(d, cross(w_ring, d));
    for (const Vector<Mpfr>& d : tilted) result.add(d, cross(w_tilted, d));
    const Vector<Mpfr> center = tilted[2] * l;
    result.add(center, cross(w_tilted, center));
    for (const Vector<Mpfr>& d : rotor) result.add(d, cross(w_rotor, d));
    return result;
  }
};

class JoinedBodies : public InDigits<40> {
 protected:
  struct End {
    Vector<Mpfr> q, v;
  };
  /// The output state of HBVM at T = 1/2.
  static End by_hbvm(const Scene& scene, int s, const char* step) {
    SceneRun<Mpfr> run(scene, s, s, step, "1/2", SolverKind::newton);
    const Integration<Mpfr> result = run({});
    StateEvaluator<Mpfr> point(run.scene.problem);
    const OutputState<Mpfr> output = output_state(point, result.end.q, result.end.p);
    End end{result.end.q, Vector<Mpfr>(result.end.q.size())};
    run.scene.problem.mass.velocity(lanes(output.p), lanes(end.v));
    return end;
  }
  static Mpfr error(const End& end, const Motion& exact) {
    return std::max(distance(end.q, exact.positions()), distance(end.v, exact.velocities()));
  }
  /// HBVM(s,s) with s = 1, 2, 3 comes near the exact motion by the order 2s, and with s = 8 to 28 digits.
  static void expect_motion(const Scene& scene, const Motion& exact) {
    EXPECT_LE(error(by_hbvm(scene, 8, "1/32"), exact), number("1e-28")) << scene.name;
    for (const int s : {1, 2, 3}) {
      const Mpfr coarse = error(by_hbvm(scene, s, "1/32"), exact), fine = error(by_hbvm(scene, s, "1/64"), exact);
      EXPECT_NEAR(order_of(coarse, fine), 2 * s, 0.2) << scene.name << ", " << s;
    }
  }

  const Mpfr T = Mpfr(1) / 2;
};

TEST_F(JoinedBodies, DoublePhysicalPendulumInItsTwoAngles) {
  expect_motion(load_scene("double_physical_pendulum"), DoublePhysicalPendulum().motion(T, 2'000));
}

/// The same bars in space, hinged to a post and to one another, the lower one turned about its length.
TEST_F(JoinedBodies, DoublePhysicalPendulumOfHinges) {
  const Scene scene = read_scene(R"(dimension = 3
[[point]]
name = "post"
position = [0, 0, "1/7"]
[[rigid_body]]
name = "upper"
position = ["3/10", "-2/5", "1/7"]
velocity = ["1/5", "3/20", 0]
mass = 2
center = [0, 0, 0]
second_moment = [["1/6", 0, 0], [0, "1/150", 0], [0, 0, "1/50"]]
directors = [["3/5", "-4/5", 0], ["4/5", "3/5", 0], [0, 0, 1]]
angular_velocity = [0, 0, "1/2"]
[[rigid_body]]
name = "lower"
position = ["63/65", "-62/65", "1/7"]
velocity = ["16/65", "-9/130", 0]
mass = 1
center = [0, 0, 0]
second_moment = [["4/75", 0, 0], [0, "1/99", 0], [0, 0, "1/1200"]]
directors = [["12/13", "-5/13", 0], [0, 0, -1], ["5/13", "12/13", 0]]
angular_velocity = [0, 0, -1]
[[constraint]]
kind = "hinge"
between = ["post", { of = "upper", at = ["-1/2", 0, 0] }]
axis = [0, 0, 3]
[[constraint]]
kind = "hinge"
between = [{ of = "upper", at = ["1/2", 0, 0] }, { of = "lower", at = ["-2/5", 0, 0] }]
axis = [0, 0, 1]
second_axis = [0, 2, 0]
[[effect]]
kind = "uniform_gravity"
acceleration = [0, -1, 0]
)",
                                 "hinges");
  const DoublePhysicalPendulum model;
  const auto [upper, lower] = model.at(T, 2'000);
  const auto in_space = [](const Vector<Mpfr>& x, const Mpfr& z) { return Vector<Mpfr>{{x[0], x[1], z}}; };
  const Vector<Mpfr> z = Vector<Mpfr>::Unit(3, 2), none = Vector<Mpfr>::Zero(3);
  const Mpfr height = Mpfr(1) / 7, half = Mpfr(1) / 2;
  Motion motion;
  motion.add(in_space(upper.along() * half, height), in_space(upper.across() * Mpfr(upper.rate * half), 0));
  motion.add(in_space(upper.along(), 0), in_space(upper.across() * upper.rate, 0));
  motion.add(in_space(upper.across(), 0), in_space(upper.along() * Mpfr(-upper.rate), 0));
  motion.add(z, none);
  motion.add(in_space(upper.along() + lower.along() * model.c2, height),
             in_space(upper.across() * upper.rate + lower.across() * Mpfr(model.c2 * lower.rate), 0));
  motion.add(in_space(lower.along(), 0), in_space(lower.across() * lower.rate, 0));
  motion.add(-z, none);
  motion.add(in_space(lower.across(), 0), in_space(lower.along() * Mpfr(-lower.rate), 0));
  expect_motion(scene, motion);
}

TEST_F(JoinedBodies, FourBarLinkageByItsEnergy) {
  const Scene scene = load_scene("four_bar_linkage_of_bars");
  const FourBarOfBars model;
  // The angle where the accurate run ends is reached at T, and all else there follows from it.
  const End end = by_hbvm(scene, 8, "1/32");
  const Mpfr angle = atan2(end.q[1], end.q[0]);
  EXPECT_LT(angle, model.first);
  EXPECT_LE(magnitude(Mpfr(model.time_to(angle, 500) - T)), number("1e-28"));
  expect_motion(scene, model.motion(angle));
}

TEST_F(JoinedBodies, GyroscopeOnAGimbalInEulersAngles) {
  expect_motion(load_scene("gyroscope_on_gimbal"), GyroscopeOnGimbal().motion(T, 2'000));
}

/// A free chain, with a hinge, a ball joint and an angle, and springs between its bodies: HBVM(s,s) keeps all momenta.
TEST_F(JoinedBodies, AFreeChainKeepsItsMomenta) {
  std::string text = joined_bodies.substr(0, joined_bodies.find("[[effect]]")) +
                     "[[effect]]\nkind = \"spring\"\nstiffness = 3\nrest_length = 1\nbetween = [[\"bead\", \"right\"], "
                     "[{ of = \"base\", at = [0, 2, 0] }, \"left\"]]\n";
  text = changed(text, rod("left", "hook", "\"sqrt(6)\""), "");
  for (const int s : {2, 3}) {
    SceneRun<Mpfr> run(read_scene(text, "chain"), s, s, "1/32", "1");
    Drift<Mpfr> drift(run.scene.problem);
    MomentumDrift<Mpfr> momenta(run.scene.problem, conserved_momenta(run.scene.problem));
    run({&drift, &momenta});
    EXPECT_LE(drift.e_g(), 1'000 * epsilon<Mpfr>());
    ASSERT_EQ(momenta.components().size(), 6u);
    for (std::size_t i = 0; i < 6; ++i)
      EXPECT_LE(momenta.drift(i), 1'000 * epsilon<Mpfr>() * momenta.size(i)) << momenta.components()[i].name();
  }
}

}  // namespace
}  // namespace hbvm::core
