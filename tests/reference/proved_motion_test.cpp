#include "reference/proved_motion.hpp"

#include "hbvm/error.hpp"
#include "printing.hpp"
#include "problem/state_evaluator.hpp"
#include "reference/known_motion.hpp"
#include "reference/proof/holds.hpp"
#include "reference/scene_tables.hpp"
#include "scalar/literal.hpp"

namespace hbvm::core {
namespace {

RealBall time_ball(const char* text) {
  RealBall t;
  arb_set_str(raw(t), text, 2'000);
  return t;
}

/// The states in the digits of the scope, errors of positions measured by `omega`.
std::vector<ProvedState> prove(const ProvedScene& scene, const std::vector<const char*>& times, double omega) {
  ProvedMotion motion(scene.exact, scene.rounded, literal<Mpfr>(times.back()), [omega](double) { return omega; });
  std::vector<ProvedState> states;
  for (const char* t : times) states.push_back(motion.at(time_ball(t)));
  return states;
}

double greatest_radius(const std::vector<RealBall>& balls) {
  double radius = 0;
  for (const RealBall& ball : balls) radius = std::max(radius, radius_of(ball));
  return radius;
}

/// Motions by elliptic functions, conics and circles, in 30 digits more than the bounds have: each component is inside,
/// at several times within one proof. The bounds keep most of the digits.
TEST(ProvedMotion, HoldsClosedForms) {
  struct Known {
    const char* scene;
    double omega;
  };
  for (const auto& [name, omega] :
       {Known{"simple_pendulum", 1}, Known{"conical_pendulum", 1}, Known{"kepler", 1}, Known{"bead_on_helix", 0.5},
        Known{"bead_on_cycloid", 0.5}, Known{"spherical_pendulum", 1}, Known{"free_rigid_body", 1},
        Known{"swinging_pendulum", 1}}) {
    const PrecisionScope digits(50);
    const std::vector<const char*> times{"0.125", "1", "3"};
    const std::vector<ProvedState> states = prove(ProvedScene(load_scene(name)), times, omega);
    const PrecisionScope more(80);
    StateEvaluator<Mpfr> point(assemble<Mpfr>(load_scene(name)).problem);
    for (std::size_t n = 0; n < times.size(); ++n) {
      const ExactPoint exact = known_motion(name, literal<Mpfr>(times[n]));
      const std::string what = std::string(name) + " at t = " + times[n];
      expect_held(states[n].q, exact.q, what + ", q");
      expect_held(states[n].p, exact.p, what + ", p");
      expect_held(states[n].lambda, exact.lambda, what + ", lambda");
      EXPECT_LT(greatest_radius(states[n].q), 1e-26) << what;
      EXPECT_LT(greatest_radius(states[n].lambda), 1e-24) << what;
    }
  }
}

/// Any rates serve: they make bounds wider, and never wrong.
TEST(ProvedMotion, HoldsWhateverErrorsAreMeasuredBy) {
  const PrecisionScope digits(60);
  const ProvedScene scene(load_scene("simple_pendulum"));
  for (const double omega : {0.25, 1.0, 16.0}) {
    const ProvedState state = prove(scene, {"2"}, omega).front();
    expect_held(state.q, known_motion("simple_pendulum", Mpfr(2)).q, "omega " + std::to_string(omega));
  }
  ProvedMotion changing(scene.exact, scene.rounded, Mpfr(2), [](double t) {
    return t < 0.7 ? 0.5 : t < 1.1 ? 6.0 : 1.0;
  });
  expect_held(changing.at(time_ball("2")).q, known_motion("simple_pendulum", Mpfr(2)).q, "rates that change");
}

/// Bounds are as good as the digits: 40 more make the radius 1e40 times smaller.
TEST(ProvedMotion, IsAsGoodAsItsDigits) {
  const auto radius = [](unsigned count) {
    const PrecisionScope digits(count);
    return greatest_radius(prove(ProvedScene(load_scene("double_pendulum")), {"2"}, 2).front().q);
  };
  const double few = radius(40), many = radius(80);
  EXPECT_LT(few, 1e-25);
  EXPECT_LT(many, few * 1e-37);
  EXPECT_GT(many, few * 1e-43);
}

/// A scene whose start is not the one of the motion that is followed: the distance of the two is in the bounds.
TEST(ProvedMotion, BelievesNothingOfTheApproximateMotion) {
  const PrecisionScope digits(40);
  const std::string oscillator = formula("-x^2/2 - y^2/2");
  const ProvedScene right(read_scene("dimension = 2\n" + body("a", "1", "[1, 0]", "[0, 0]") + oscillator, "right"));
  // What TaylorMotion is given is off by 1e-10 in the start, and by 1e-9 in the force.
  const ProvedScene start(
      read_scene("dimension = 2\n" + body("a", "1", "[\"1 + 1/10^10\", 0]", "[0, 0]") + oscillator, "start"));
  const ProvedScene force(read_scene(
      "dimension = 2\n" + body("a", "1", "[1, 0]", "[0, 0]") + formula("-(1 + 1/10^9)*x^2/2 - y^2/2"), "force"));
  for (const ProvedScene* wrong : {&start, &force}) {
    ProvedMotion motion(right.exact, wrong->rounded, Mpfr(2), [](double) { return 1.0; });
    const ProvedState state = motion.at(time_ball("2"));
    EXPECT_TRUE(holds(state.q[0], cos(Mpfr(2)))) << text_of(state.q[0]);
    EXPECT_TRUE(holds(state.p[0], -sin(Mpfr(2)))) << text_of(state.p[0]);
    EXPECT_LT(radius_of(state.q[0]), 1e-8);
    EXPECT_GT(radius_of(state.q[0]), 4e-11);
  }
}

/// Errors grow where the exact motion is, and not only where the approximate one is: here x'' = x^3, whose errors grow
/// faster farther out. The start is off by a tenth along the direction that grows most.
TEST(ProvedMotion, LooksAtAllOfItsTube) {
  const PrecisionScope digits(40);
  const auto scene = [](const std::string& x, const std::string& v) {
    return read_scene("dimension = 1\n" + body("a", "1", "[\"" + x + "\"]", "[\"" + v + "\"]") + formula("x^4/4"),
                      "quartic");
  };
  const ProvedScene right(scene("1 + 1/10", "sqrt(3)/10")), near(scene("1", "0"));
  ProvedMotion motion(right.exact, near.rounded, literal<Mpfr>("1/10"), [](double) { return 1.732; });
  TaylorMotion exact(right.rounded.problem, right.rounded.q0, right.rounded.p0);
  exact.advance_to(literal<Mpfr>("1/10"));
  const ProvedState state = motion.at(time_ball("0.1"));
  expect_held(state.q, exact.q(), "q");
  expect_held(state.p, exact.p(), "p");
  EXPECT_LT(radius_of(state.q[0]), 0.5);
}

/// Long work can be ended on the way: its caller is asked at each coefficient and at each piece of a step.
TEST(ProvedMotion, AsksManyTimesAStep) {
  struct Ended {};
  const PrecisionScope digits(40);
  const ProvedScene scene(load_scene("double_pendulum"));
  long of_taylor = 0, of_proof = 0;
  TaylorMotion taylor(scene.rounded.problem, scene.rounded.q0, scene.rounded.p0, [&] { ++of_taylor; });
  ProvedMotion proof(
      scene.exact, scene.rounded, Mpfr(1), [](double) { return 2.0; }, [&] { ++of_proof; });
  EXPECT_GT(of_proof, of_taylor);
  const auto end_after = [&](long calls) {
    ProvedMotion(
        scene.exact, scene.rounded, Mpfr(1), [](double) { return 2.0; },
        [&] {
          if (calls-- == 0) throw Ended();
        });
  };
  EXPECT_THROW(end_after(0), Ended);
  EXPECT_THROW(end_after(of_proof - 1), Ended);
  EXPECT_NO_THROW(end_after(of_proof));
}

/// Where the motion ends, or two constraints become one, nothing is said beyond.
TEST(ProvedMotion, IsRefusedWhereTheMotionEnds) {
  const PrecisionScope digits(30);
  const ProvedScene fall(read_scene("dimension = 2\n" + point("sun", "[0, 0]") + body("a", "1", "[1, 0]", "[0, 0]") +
                                        effect("central_gravity", "center = \"sun\"\nstrength = 1"),
                                    "fall into a centre"));
  EXPECT_THROW(prove(fall, {"2"}, 1), IntegrationError);
}

}  // namespace
}  // namespace hbvm::core
