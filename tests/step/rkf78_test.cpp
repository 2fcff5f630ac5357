#include <gtest/gtest.h>

#include <cmath>

#include "printing.hpp"
#include "problem/state_evaluator.hpp"
#include "step/odeint_methods.hpp"
#include "step/stepping.hpp"

namespace hbvm::core {
namespace {

/// Order 8 in q, p and the multiplier of the end; what is lost of g and of the hidden constraints, too.
TEST(Rkf78, HasOrder8) {
  const PrecisionScope digits(60);
  for (const char* const name : {"double_pendulum", "modified_pendulum", "kepler"}) {
    const Assembled<Mpfr> scene = assemble<Mpfr>(load_scene(name));
    StateEvaluator<Mpfr> point(scene.problem);
    const State<Mpfr> exact = after("hbvm:16,16", scene, Mpfr(1) / 16, 8);
    const Vector<Mpfr> p = point.tangential(exact.q, exact.p), lambda = point.multiplier(exact.q, p);
    const auto end = [&](long steps) { return end_of("rkf78", scene, Mpfr(1) / (2 * steps), steps); };
    const auto rate = [&](const auto& error) { return order_of<Mpfr>(error(end(32)), error(end(64))); };
    EXPECT_NEAR(rate([&](const auto& x) { return distance(x.first.q, exact.q); }), 8, 0.5) << name;
    EXPECT_NEAR(rate([&](const auto& x) { return distance(x.first.p, p); }), 8, 0.5) << name;
    if (scene.problem.nu() == 0) continue;
    EXPECT_NEAR(rate([&](const auto& x) { return distance(x.second, lambda); }), 8, 0.5) << name;
    EXPECT_GT(rate([&](const auto& x) { return max_norm(point.constraints(x.first.q)); }), 7.5) << name;
  }
}

template <class S>
class Rkf78Test : public InDigits<50> {};
TYPED_TEST_SUITE(Rkf78Test, AllScalars, ScalarNames);

/// Short steps leave nothing but round-off, in every number type.
TYPED_TEST(Rkf78Test, IsRightToTheLastDigits) {
  using S = TypeParam;
  const Assembled<S> scene = assemble<S>(load_scene("double_pendulum"));
  const long parts = std::same_as<S, double> ? 64 : std::same_as<S, Quad> ? 8192 : 262144;
  // As long as that takes: sixteen steps.
  const State<S> state = after("rkf78", scene, S(1) / S(parts), 16),
                 exact = after("hbvm:12,12", scene, S(1) / S(parts), 16, SolverKind::automatic);
  EXPECT_LE(distance(state.q, exact.q), 64 * epsilon<S>());
}

/// Thirteen a step: what ends a step begins the next.
TEST(Rkf78, CountsItsEvaluations) {
  SceneSteps<double> satellites(load_scene("tethered_satellites"), "rkf78");
  for (int n = 0; n < 10; ++n) EXPECT_EQ(satellites.step(0.05).sweeps, 1);
  EXPECT_EQ(satellites.stepper->counts().effects[0].evaluations, 131U);
}

}  // namespace
}  // namespace hbvm::core
