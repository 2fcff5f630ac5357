#include "step/lobatto.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "method/order_conditions.hpp"
#include "method/runge_kutta.hpp"
#include "method/symmetry_defect.hpp"
#include "printing.hpp"
#include "problem/point.hpp"
#include "scene/assemble.hpp"
#include "step/registry.hpp"

namespace hbvm::core {
namespace {

template <class S>
class LobattoTest : public ::testing::Test {
 protected:
  PrecisionScope digits{50};
};
TYPED_TEST_SUITE(LobattoTest, AllScalars, ScalarNames);

/// Hairer, Lubich, Wanner: tables II.1.1 and II.1.2, s = 3.
TYPED_TEST(LobattoTest, CoefficientsOfThreeStages) {
  using S = TypeParam;
  const Lobatto<S> method = make_lobatto<S>(3);
  const S sixth = S(1) / 6;
  const S A[3][3] = {{0, 0, 0}, {S(5) / 24, S(1) / 3, S(-1) / 24}, {sixth, S(2) / 3, sixth}};
  const S A_hat[3][3] = {{sixth, -sixth, 0}, {sixth, S(1) / 3, 0}, {sixth, S(5) / 6, 0}};
  for (Index i = 0; i < 3; ++i) {
    EXPECT_LE(magnitude(S(method.c[i] - S(static_cast<long>(i)) / 2)), epsilon<S>());
    for (Index j = 0; j < 3; ++j) {
      EXPECT_LE(magnitude(S(method.A(i, j) - A[i][j])), epsilon<S>()) << i << j;
      EXPECT_LE(magnitude(S(method.A_hat(i, j) - A_hat[i][j])), epsilon<S>()) << i << j;
    }
  }
}

/// IIIA has B(2s - 2), C(s), D(s - 2); IIIB B(2s - 2), C(s - 2), D(s).
TYPED_TEST(LobattoTest, CoefficientsMeetTheirConditions) {
  using S = TypeParam;
  for (const int s : {2, 4, 5, 9, 20}) {
    const Lobatto<S> method = make_lobatto<S>(s);
    const RungeKutta<S> a{method.A, method.b, method.c}, b{method.A_hat, method.b, method.c};
    const S tolerance = 4 * S(s) * epsilon<S>();
    EXPECT_LE(condition_B(a, 2 * s - 2), tolerance) << s;
    EXPECT_LE(condition_C(a, s), tolerance) << s;
    EXPECT_LE(condition_D(a, s - 2), tolerance) << s;
    EXPECT_LE(condition_C(b, s - 2), tolerance) << s;
    EXPECT_LE(condition_D(b, s), tolerance) << s;
    EXPECT_LE(symmetry_defect(a), tolerance) << s;
    EXPECT_LE(symmetry_defect(b), tolerance) << s;
    for (Index i = 0; i < s; ++i) {
      EXPECT_EQ(method.A(0, i), 0);
      EXPECT_EQ(method.A_hat(i, s - 1), 0);
      EXPECT_EQ(method.A(s - 1, i), method.b[i]);
    }
  }
}

template <Scalar S>
State<S> after(const char* method, const Assembled<S>& scene, const S& h, long steps) {
  const auto stepper = parse_method(method)->make_stepper(scene.problem, SolverKind::newton);
  State<S> state(scene.q0, scene.p0);
  for (long n = 0; n < steps; ++n) stepper->step(state, h);
  return state;
}

/// Two stages are RATTLE.
TYPED_TEST(LobattoTest, OfTwoStagesIsRattle) {
  using S = TypeParam;
  for (const char* const name : {"double_pendulum", "kepler", "heavy_top"}) {
    const Assembled<S> scene = assemble<S>(load_scene(name));
    const State<S> lobatto = after<S>("lobatto:2", scene, S(S(1) / 64), 20),
                   rattle = after<S>("rattle", scene, S(S(1) / 64), 20);
    EXPECT_LE(distance(lobatto.q, rattle.q), 10'000 * epsilon<S>()) << name;
    EXPECT_LE(distance(lobatto.p, rattle.p), 10'000 * epsilon<S>()) << name;
  }
}

/// The error at a fixed time falls by 2^(2s - 2), with constraints and without.
TEST(Lobatto, HasOrder2sMinus2) {
  const PrecisionScope digits(60);
  for (const char* const name : {"double_pendulum", "kepler", "bead_on_ellipsoid"}) {
    const Assembled<Mpfr> scene = assemble<Mpfr>(load_scene(name));
    const State<Mpfr> expected = after<Mpfr>("hbvm:16,16", scene, Mpfr(Mpfr(1) / 32), 8);
    for (const int s : {2, 3, 4, 5}) {
      const std::string method = "lobatto:" + std::to_string(s);
      const auto error = [&](long steps) {
        return distance(after<Mpfr>(method.c_str(), scene, Mpfr(Mpfr(1) / (4 * steps)), steps).q, expected.q);
      };
      EXPECT_NEAR(std::log2(approximately(Mpfr(error(16) / error(32)))), 2 * s - 2, 0.2) << name << " " << method;
    }
  }
}

TYPED_TEST(LobattoTest, KeepsConstraintsAndComesBack) {
  using S = TypeParam;
  for (const char* const name : {"double_pendulum", "tethered_satellites", "charged_tetrahedron"}) {
    const Assembled<S> scene = assemble<S>(load_scene(name));
    const auto stepper = parse_method("lobatto:3")->make_stepper(scene.problem, SolverKind::automatic);
    State<S> state(scene.q0, scene.p0);
    const S h = S(1) / 64;
    Point<S> point(scene.problem);
    for (int n = 0; n < 16; ++n) {
      stepper->step(state, h);
      EXPECT_LE(max_norm(point.constraints(state.q)), 32 * epsilon<S>() * point.constraint_size(state.q)) << name;
      EXPECT_LE(max_norm(point.hidden_constraints(state.q, state.p)), 256 * epsilon<S>()) << name;
    }
    state.p = -state.p;
    state.p_carry = -state.p_carry;
    for (int n = 0; n < 16; ++n) stepper->step(state, h);
    EXPECT_LE(distance(state.q, scene.q0), 4'096 * epsilon<S>()) << name;
    EXPECT_LE(distance(state.p, Vector<S>(-scene.p0)), 65'536 * epsilon<S>()) << name;
  }
}

TYPED_TEST(LobattoTest, GoesOnFromWhatItRemembers) {
  using S = TypeParam;
  const Assembled<S> scene = assemble<S>(load_scene("double_pendulum"));
  const auto make = parse_method("lobatto:3")->prepare(scene.problem, SolverKind::automatic);
  const auto whole = make(), part = make();
  const S h = S(1) / 32;
  State<S> state(scene.q0, scene.p0);
  for (int n = 0; n < 5; ++n) whole->step(state, h);
  Archive writing;
  writing(*whole, state);
  Archive reading(writing.text());
  State<S> resumed = state;
  reading(*part, resumed);
  reading.expect_end();
  for (int n = 0; n < 3; ++n) EXPECT_EQ(part->step(resumed, h), whole->step(state, h));
  EXPECT_EQ(resumed.q, state.q);
  EXPECT_EQ(resumed.p_carry, state.p_carry);
  EXPECT_EQ(part->multiplier(), whole->multiplier());
}

TEST(Lobatto, RefusesAndFailsWithItsReason) {
  for (const char* const text : {"lobatto", "lobatto:", "lobatto:1", "lobatto:0", "lobatto:201", "lobatto:3x"})
    EXPECT_THROW(parse_method(text), InputError) << text;
  const Assembled<double> scene = assemble<double>(load_scene("double_pendulum"));
  const auto stepper = parse_method("lobatto:3")->make_stepper(scene.problem, SolverKind::automatic);
  State<double> state(scene.q0, scene.p0);
  EXPECT_THROW(stepper->step(state, 100), StageFailure);
  EXPECT_EQ(state.q, scene.q0);
  EXPECT_EQ(state.p, scene.p0);
}

}  // namespace
}  // namespace hbvm::core
