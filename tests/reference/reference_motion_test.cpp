#include "reference/reference_motion.hpp"

#include <cmath>
#include <limits>

#include "printing.hpp"
#include "reference/known_motion.hpp"
#include "scalar/literal.hpp"
#include "scene/assemble.hpp"
#include "step/hbvm_stepper.hpp"

namespace hbvm::core {
namespace {

double greatest_error(const ReferenceMotion& motion) {
  return std::max({motion.errors().q, motion.errors().p, motion.errors().lambda});
}

class ReferenceMotionTest : public InDigits<50> {
 protected:
  const Assembled<Mpfr> pendulum = assemble<Mpfr>(load_scene("simple_pendulum"));
  const Mpfr duration = literal<Mpfr>("1/2");

  ReferenceMotion motion(long steps, int stages) const {
    return {pendulum.problem, pendulum.q0, pendulum.p0, duration, steps, stages};
  }
  /// log2 of the error of q, p and lambda.
  double true_error(const ReferenceMotion& m) const {
    const ExactPoint exact = known_motion("simple_pendulum", duration);
    Mpfr error = distance(m.q(), exact.q);
    raise_to(error, distance(m.p(), exact.p));
    raise_to(error, distance(m.lambda(), exact.lambda));
    return log2_of(error);
  }
  /// Of some thousand operations in the digits of the scope.
  static double round_off() { return 10.0 - mpfr_working_bits(); }
};

TEST_F(ReferenceMotionTest, ErrorIsAtLeastTheTrueOneAndNotFarAbove) {
  for (const auto& [steps, stages] : {std::pair(2, 1), {4, 2}, {2, 4}, {1, 6}, {4, 6}}) {
    const ReferenceMotion m = motion(steps, stages);
    const double error = true_error(m);
    EXPECT_LT(greatest_error(m), 0);
    EXPECT_GE(std::max(greatest_error(m), round_off()), error) << steps << " steps, " << stages << " stages";
    // It is that of two stages less, greater by h^-4, 2^12 at most, and by constants that fall about as much.
    EXPECT_LE(greatest_error(m), std::max(error, round_off()) + 24) << steps << " steps, " << stages << " stages";
  }
}

/// The estimates are the errors of the run before, of two stages less, which a run of one's own shows.
TEST_F(ReferenceMotionTest, ErrorsAreThoseOfTheRunBefore) {
  const ExactPoint exact = known_motion("simple_pendulum", duration);
  StateEvaluator<Mpfr> point(pendulum.problem);
  for (const auto& [steps, stages] : {std::pair(1, 2), {2, 3}, {4, 4}}) {
    const Hbvm<Mpfr> method = make_hbvm<Mpfr>(stages, stages);
    HbvmStepper<Mpfr> stepper(pendulum.problem, method, SolverKind::fixed_point);
    State<Mpfr> state(pendulum.q0, pendulum.p0);
    for (int n = 0; n < steps; ++n) stepper.step(state, Mpfr(duration / steps));
    const Vector<Mpfr> p = point.tangential(state.q, state.p), lambda = point.multiplier(state.q, p);
    const ReferenceMotion::Errors errors = motion(steps, stages).errors();
    constexpr double bits = 0.1;  // the run of two stages more is not exact either
    EXPECT_NEAR(errors.q, log2_of(distance(state.q, exact.q)), bits) << stages << " stages";
    EXPECT_NEAR(errors.p, log2_of(distance(p, exact.p)), bits) << stages << " stages";
    EXPECT_NEAR(errors.lambda, log2_of(distance(lambda, exact.lambda)), bits) << stages << " stages";
  }
}

TEST_F(ReferenceMotionTest, RefiningLowersTheErrorDownToRoundOff) {
  ReferenceMotion m = motion(2, 2);
  double error = greatest_error(m), truth = true_error(m);
  int runs = 0;
  while (m.refine()) {
    ASSERT_LT(++runs, 40);
    EXPECT_LT(greatest_error(m), error);
    EXPECT_LE(true_error(m), std::max(truth, round_off()));
    error = greatest_error(m);
    truth = true_error(m);
  }
  EXPECT_GE(runs, 3);
  EXPECT_LE(greatest_error(m), round_off());
  EXPECT_LE(truth, round_off());
}

TEST_F(ReferenceMotionTest, MoreDigitsGoDeeper) {
  const PrecisionScope more(100);
  const Assembled<Mpfr> scene = assemble<Mpfr>(load_scene("simple_pendulum"));
  ReferenceMotion m(scene.problem, scene.q0, scene.p0, literal<Mpfr>("1/2"), 2, 10);
  for (int n = 0; n < 40 && m.refine(); ++n) {
  }
  const ExactPoint exact = known_motion("simple_pendulum", literal<Mpfr>("1/2"));
  EXPECT_LE(log2_of(distance(m.q(), exact.q)), round_off());
}

TEST_F(ReferenceMotionTest, EndsOnTheManifold) {
  const ReferenceMotion m = motion(2, 3);
  StateEvaluator<Mpfr> point(pendulum.problem);
  EXPECT_LE(log2_of(max_norm(point.constraints(m.q()))), round_off());
  EXPECT_LE(log2_of(max_norm(point.hidden_constraints(m.q(), m.p()))), round_off());
}

TEST_F(ReferenceMotionTest, PolynomialsOfOneStepGoFromStartToEnd) {
  const ReferenceMotion m = motion(1, 12);
  const StepPolynomials& step = m.polynomials();
  EXPECT_EQ(step.h, duration);
  Vector<Mpfr> u(2), v(2);
  step.at(pendulum.problem, Mpfr(0), u, v);
  EXPECT_LE(log2_of(distance(u, pendulum.q0)), round_off());
  EXPECT_LE(log2_of(distance(v, pendulum.p0)), round_off());
  step.at(pendulum.problem, Mpfr(1), u, v);
  EXPECT_LE(log2_of(distance(u, m.q())), round_off());
  EXPECT_LE(log2_of(distance(v, step.p1)), round_off());
  // p is v(h), of order s only, after its projection.
  StateEvaluator<Mpfr> point(pendulum.problem);
  EXPECT_LE(log2_of(distance(point.tangential(u, v), m.p())), round_off());
}

TEST_F(ReferenceMotionTest, PolynomialsAreOfTheLastStep) {
  const ReferenceMotion m = motion(4, 8);
  EXPECT_EQ(m.polynomials().h, Mpfr(duration / 4));
  Vector<Mpfr> u(2), v(2);
  m.polynomials().at(pendulum.problem, Mpfr(0), u, v);
  const ExactPoint before = known_motion("simple_pendulum", Mpfr(duration * 3 / 4));
  EXPECT_LE(log2_of(distance(u, before.q)), greatest_error(m));
  StateEvaluator<Mpfr> point(pendulum.problem);
  EXPECT_LE(log2_of(distance(point.tangential(u, v), before.p)), greatest_error(m));
}

/// Inside a step the polynomials are the motion up to O(h^(s+1)), Corollary 2.
TEST_F(ReferenceMotionTest, PolynomialsFollowTheMotion) {
  const auto worst = [&](const char* length, int stages) {
    const Mpfr time = literal<Mpfr>(length);
    const ReferenceMotion m(pendulum.problem, pendulum.q0, pendulum.p0, time, 1, stages);
    EXPECT_EQ(m.polynomials().gamma.rows(), stages + 2) << "it has been refined once";
    Vector<Mpfr> u(2), v(2);
    Mpfr error = 0;
    for (int n = 1; n < 8; ++n) {
      const Mpfr tau = Mpfr(n) / 8;
      m.polynomials().at(pendulum.problem, tau, u, v);
      const ExactPoint exact = known_motion("simple_pendulum", Mpfr(tau * time));
      raise_to(error, distance(u, exact.q));
      raise_to(error, distance(v, exact.p));
    }
    return log2_of(error);
  };
  const double rate = (worst("1/64", 4) - worst("1/1024", 4)) / 4;
  EXPECT_NEAR(rate, 7, double{1} / 2) << "six stages";
}

/// Gauss's steps on constraints by formulas: to round-off, and errors that are no less than the true ones on the way.
TEST(ReferenceMotionOnAWire, ComesToItsClosedForm) {
  const PrecisionScope digits(60);
  for (const char* name : {"bead_on_helix", "bead_on_cycloid"}) {
    const Assembled<Mpfr> scene = assemble<Mpfr>(load_scene(name));
    const Mpfr duration = literal<Mpfr>("3/4");
    const ExactPoint exact = known_motion(name, duration);
    ReferenceMotion m(scene.problem, scene.q0, scene.p0, duration, 2, 4);
    const double few = 14.0 - mpfr_working_bits();
    int runs = 0;
    do {
      ASSERT_LT(++runs, 60);
      EXPECT_LE(log2_of(distance(m.q(), exact.q)), std::max(m.errors().q, few)) << name;
      EXPECT_LE(log2_of(distance(m.p(), exact.p)), std::max(m.errors().p, few)) << name;
      EXPECT_LE(log2_of(distance(m.lambda(), exact.lambda)), std::max(m.errors().lambda, few)) << name;
    } while (m.refine());
    EXPECT_GE(runs, 3) << name;
    EXPECT_LE(greatest_error(m), few) << name;
  }
}

TEST(Log2, IsOfTheMagnitude) {
  const PrecisionScope digits(50);
  EXPECT_EQ(log2_of(Mpfr(1)), 0);
  EXPECT_EQ(log2_of(Mpfr(-8)), 3);
  EXPECT_EQ(log2_of(Mpfr(1) / 4), -2);
  EXPECT_EQ(log2_of(Mpfr(0)), -std::numeric_limits<double>::infinity());
  EXPECT_DOUBLE_EQ(log2_of(Mpfr(10)), std::log2(10));
  // Far outside the range of double.
  EXPECT_DOUBLE_EQ(log2_of(pow(Mpfr(2), -1'000'000)), -1'000'000);
  EXPECT_DOUBLE_EQ(log2_of(pow(Mpfr(10), 5'000)), 5'000 * std::log2(10));
}

}  // namespace
}  // namespace hbvm::core
