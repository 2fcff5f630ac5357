#include "run/proof/proved_course.hpp"

#include "interruption.hpp"
#include "printing.hpp"
#include "problem/state_evaluator.hpp"
#include "reference/proof/holds.hpp"
#include "reference/scene_tables.hpp"
#include "runs/proof/discrete_motion.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

constexpr unsigned few_digits = 40;

/// A course in the digits of the scope that is open while it is made.
struct CourseOf {
  CourseOf(const Scene& scene, const HbvmName& name, const std::string& h)
      : both(scene), method(HbvmMethod(name).coefficients<Mpfr>(name.r)), course(both.exact, both.rounded, method, [&] {
          const PrecisionScope twice(2 * few_digits + 20);
          return believed(evaluate<Mpfr>(Expression::parse(h), scene.constants));
        }()) {}

  ProvedScene both;
  Hbvm<Mpfr> method;
  ProvedCourse course;
};

/// All of a motion with 30 digits more is in the balls of each step.
TEST(ProvedCourse, HoldsTheMotionWithMoreDigits) {
  const std::vector<std::pair<const char*, HbvmName>> cases{
      {"tethered_satellites", {5, 3, 3}}, {"heavy_top", {3, 3, 3}},        {"heavy_top", {4, 2, 2}},
      {"bead_on_torus", {4, 3, 5}},       {"four_bar_linkage", {3, 2, 2}}, {"kepler", {4, 1, 1}}};
  for (const auto& [name, method] : cases) {
    SCOPED_TRACE(std::string(name) + " " + method.text());
    const PrecisionScope digits(few_digits);
    CourseOf proved(load_scene(name), method, "1/20");
    DiscreteMotion motion(load_scene(name), method, "1/20");
    for (int n = 1; n <= 6; ++n) {
      {
        const PrecisionScope again(few_digits);
        proved.course.step();
      }
      motion.step();
      const DiscreteState state = proved.course.state();
      expect_held(state.q, motion.state().q, "q");
      expect_held(state.p, motion.state().p, "p");
      expect_held(proved.course.multipliers(), motion.multiplier(), "lambda");
      for (const RealBall& x : state.q) EXPECT_LT(radius_of(x), 1e-34);
      for (const RealBall& x : state.p) EXPECT_LT(radius_of(x), 1e-34);
      for (const RealBall& x : proved.course.multipliers()) EXPECT_LT(radius_of(x), 1e-31);
      StateEvaluator<Mpfr> point(motion.problem());
      const BallScope bits(240);
      EXPECT_TRUE(holds(state.H(), point.energy(motion.state().q, motion.state().p)));
      expect_held(state.g, point.constraints(motion.state().q), "g");
    }
    EXPECT_EQ(proved.course.steps(), 6);
  }
}

/// A coefficient that is wrong in its 25th digit gives a motion that is in no ball.
TEST(ProvedCourse, NoticesAWrongCoefficient) {
  using enum Perturbation::Part;
  const PrecisionScope digits(few_digits);
  const auto wrong_by = [](Perturbation::Part part, bool hat, int i) {
    return Perturbation{.part = part, .hat = hat, .i = i, .j = 0, .relative = Expression::parse("1e-25")};
  };
  for (const Perturbation& wrong : {wrong_by(X, false, 1), wrong_by(weight, true, 0), wrong_by(integral, false, 2)}) {
    CourseOf proved(load_scene("tethered_satellites"), {5, 3, 3}, "1/10");
    proved.course.step();
    DiscreteMotion motion(load_scene("tethered_satellites"), {5, 3, 3}, "1/10", wrong);
    motion.step();
    const DiscreteState state = proved.course.state();
    int held = 0;
    for (Index j = 0; j < motion.problem().m(); ++j)
      held += holds(state.p[static_cast<std::size_t>(j)], motion.state().p[j]) ? 1 : 0;
    EXPECT_LE(held, 3) << static_cast<int>(wrong.part);  // some components vanish, whatever the method
  }
}

/// The step is as exact as it is written: a third is no decimal.
TEST(ProvedCourse, TakesTheExactStep) {
  const PrecisionScope digits(few_digits);
  CourseOf proved(load_scene("kepler"), {2, 1, 1}, "1/3");
  DiscreteMotion motion(load_scene("kepler"), {2, 1, 1}, "1/3"),
      rounded(load_scene("kepler"), {2, 1, 1}, "0.333333333333333333333333333333333");
  {
    const PrecisionScope again(few_digits);
    proved.course.step();
  }
  motion.step();
  rounded.step();
  expect_held(proved.course.state().q, motion.state().q, "q");
  EXPECT_FALSE(holds(proved.course.state().q[0], rounded.state().q[0]));
}

/// A pendulum that hangs at rest.
TEST(ProvedCourse, ProvesRest) {
  const Scene scene =
      read_scene("dimension = 2\n" + point("o", "[0, 0]") + body("a", "1", "[0, -1]", "[0, 0]") +
                     "[[constraint]]\nkind = \"rod\"\nbetween = [\"o\", \"a\"]\nlength = 1\n" + field("[0, -1]"),
                 "rest");
  const PrecisionScope digits(few_digits);
  CourseOf proved(scene, {2, 2, 2}, "1/10");
  for (int n = 0; n < 3; ++n) proved.course.step();
  EXPECT_TRUE(holds(proved.course.state().q[1], Mpfr(-1)));
  EXPECT_TRUE(proved.course.state().p[0].holds_zero());
  EXPECT_TRUE(holds(proved.course.multipliers()[0], Mpfr(1) / 2));
}

/// What no other solution is nearer than is a part of the momenta, and does not fall with the digits.
TEST(ProvedCourse, TellsHowFarOtherSolutionsAre) {
  for (const unsigned count : {25U, 100U}) {
    const PrecisionScope digits(count);
    CourseOf proved(load_scene("double_pendulum"), {3, 2, 2}, "1/10");
    for (int n = 0; n < 3; ++n) proved.course.step();
    const double radius = centre_of(raw(proved.course.radius()));
    EXPECT_GT(radius, 1e-3);
    EXPECT_LE(radius, 0.5);
  }
}

TEST(ProvedCourse, EndsWhenItIsAsked) {
  const PrecisionScope digits(few_digits);
  CourseOf proved(load_scene("double_pendulum"), {3, 2, 2}, "1/10");
  const std::stop_source asked;
  const StopRequest request{asked.get_token(), nullptr};
  const StopScope scope(&request);
  proved.course.step();
  std::stop_source(asked).request_stop();
  EXPECT_THROW(proved.course.step(), Interrupted);
}

}  // namespace
}  // namespace hbvm::core
