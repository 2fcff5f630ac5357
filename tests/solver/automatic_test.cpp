#include "solver/automatic.hpp"

#include "printing.hpp"
#include "step/stepping.hpp"

namespace hbvm::core {
namespace {

/// A body of mass 1 in a harmonic well of frequency 1. The fixed point of the midpoint rule converges by h^2/4 a sweep,
/// and not from h = 2 on.
template <Scalar S>
struct Oscillation : SceneSteps<S> {
  S h;

  Oscillation(SolverKind kind, const S& step_size)
      : SceneSteps<S>(read_scene("dimension = 2\npoint = [{ name = \"O\", position = [0, 0] }]\n"
                                 "body = [{ name = \"a\", mass = 1, position = [1, 0], velocity = [0.5, 1] }]\n"
                                 "effect = [{ kind = \"trap\", center = \"O\", stiffness = 1, exponent = 2 }]\n",
                                 "oscillator"),
                      "hbvm:1,1", kind),
        h(step_size) {}
  long sweeps() { return this->step(h).sweeps; }
};

/// q^2 + p^2, which the midpoint rule keeps.
template <Scalar S>
S energy(const State<S>& state) {
  return state.q.squaredNorm() + state.p.squaredNorm();
}

TEST(Automatic, InDoubleIsTheFixedPointWhereThatIsFast) {
  Oscillation<double> automatic(SolverKind::automatic, 0.125), fixed_point(SolverKind::fixed_point, 0.125);
  for (int n = 0; n < 20; ++n) {
    const long sweeps = fixed_point.sweeps();
    EXPECT_LE(sweeps, Automatic<double>::slow);
    EXPECT_EQ(automatic.sweeps(), sweeps) << n;
    EXPECT_EQ(automatic.state.q, fixed_point.state.q) << n;
    EXPECT_EQ(automatic.state.p, fixed_point.state.p) << n;
  }
}

TEST(Automatic, InDoubleTurnsToNewtonAfterASlowStep) {
  Oscillation<double> automatic(SolverKind::automatic, 1.75), fixed_point(SolverKind::fixed_point, 1.75);
  const double start = energy(automatic.state);
  const long first = fixed_point.sweeps();
  EXPECT_GT(first, Automatic<double>::slow);
  EXPECT_EQ(automatic.sweeps(), first) << "the first step is the fixed point's";
  for (int n = 0; n < 10; ++n) {
    EXPECT_LE(automatic.sweeps(), 14) << n;
    EXPECT_GT(fixed_point.sweeps(), 14) << n;
  }
  EXPECT_NEAR(energy(automatic.state), start, 64 * epsilon<double>() * start);
}

TEST(Automatic, InDoubleTurnsToNewtonWhereTheFixedPointFails) {
  Oscillation<double> fixed_point(SolverKind::fixed_point, 3.0);
  EXPECT_THROW(fixed_point.sweeps(), StageFailure);
  Oscillation<double> automatic(SolverKind::automatic, 3.0), newton(SolverKind::newton, 3.0);
  const double start = energy(automatic.state);
  long sweeps = 0, first = 0;
  for (int n = 0; n < 10; ++n) {
    ASSERT_NO_THROW(sweeps = automatic.sweeps()) << n;
    const long of_newton = newton.sweeps();
    if (n == 0) {
      first = sweeps;
      continue;
    }
    EXPECT_EQ(sweeps, of_newton) << "the fixed point is tried again at step " << n;
    // Newton follows the solution of so long a step from shorter ones.
    EXPECT_LT(sweeps, first - 20) << "it is not tried again at step " << n;
  }
  EXPECT_NEAR(energy(automatic.state), start, 64 * epsilon<double>() * start);
}

template <class S>
class AutomaticBeyondDouble : public InDigits<50> {};
using ManyDigits = ::testing::Types<Quad, Mpfr>;
TYPED_TEST_SUITE(AutomaticBeyondDouble, ManyDigits, ScalarNames);

/// The fixed point in double makes the start, and a few of Newton's sweeps in all digits the rest.
TYPED_TEST(AutomaticBeyondDouble, IsNewtonFromWhatTheFixedPointFindsInDouble) {
  using S = TypeParam;
  Oscillation<double> in_double(SolverKind::fixed_point, 0.125);
  Oscillation<S> automatic(SolverKind::automatic, S(S(1) / 8)), newton(SolverKind::newton, S(S(1) / 8)),
      fixed_point(SolverKind::fixed_point, S(S(1) / 8));
  for (int n = 0; n < 5; ++n) {
    const long sweeps = automatic.sweeps();
    EXPECT_LT(sweeps, fixed_point.sweeps()) << n;
    EXPECT_LE(sweeps - in_double.sweeps(), 4) << n;
    newton.sweeps();
    EXPECT_LE(distance(automatic.state.q, newton.state.q), 8 * epsilon<S>()) << n;
  }
}

TYPED_TEST(AutomaticBeyondDouble, IsNewtonAloneWhereTheFixedPointFails) {
  using S = TypeParam;
  Oscillation<S> automatic(SolverKind::automatic, S(3)), newton(SolverKind::newton, S(3));
  EXPECT_GT(automatic.sweeps(), newton.sweeps());
  for (int n = 1; n < 5; ++n) {
    EXPECT_EQ(automatic.sweeps(), newton.sweeps()) << "the fixed point is tried again at step " << n;
    EXPECT_EQ(automatic.state.q, newton.state.q) << n;
  }
}

TYPED_TEST(AutomaticBeyondDouble, IsNewtonAloneAfterASlowStep) {
  using S = TypeParam;
  const S h = S(7) / 4;
  Oscillation<S> automatic(SolverKind::automatic, h), newton(SolverKind::newton, h);
  const long first = automatic.sweeps();
  EXPECT_GT(first, Automatic<S>::slow);
  newton.sweeps();
  for (int n = 1; n < 5; ++n) {
    EXPECT_LT(automatic.sweeps(), first) << n;
    newton.sweeps();
    EXPECT_LE(distance(automatic.state.q, newton.state.q), 8 * epsilon<S>()) << n;
  }
}

}  // namespace
}  // namespace hbvm::core
