#include <gtest/gtest.h>

#include <cmath>

#include "printing.hpp"
#include "problem/state_evaluator.hpp"
#include "scene/assemble.hpp"
#include "step/odeint_methods.hpp"
#include "step/registry.hpp"

namespace hbvm::core {
namespace {

/// Order 8 in q, p and the multiplier of the end; what is lost of g and of the hidden constraints, too.
TEST(Rkf78, HasOrder8) {
  const PrecisionScope digits(60);
  for (const char* const name : {"double_pendulum", "modified_pendulum", "kepler"}) {
    const Assembled<Mpfr> scene = assemble<Mpfr>(load_scene(name));
    StateEvaluator<Mpfr> point(scene.problem);
    const auto end = [&](const char* method, long steps) {
      const auto stepper = parse_method(method)->make_stepper(scene.problem, SolverKind::newton);
      State<Mpfr> state(scene.q0, scene.p0);
      StepResult<Mpfr> last;
      for (long n = 0; n < steps; ++n) last = stepper->step(state, Mpfr(Mpfr(1) / (2 * steps)));
      return std::pair(state, *last.multiplier);
    };
    const State<Mpfr> exact = end("hbvm:16,16", 8).first;
    const Vector<Mpfr> p = point.tangential(exact.q, exact.p), lambda = point.multiplier(exact.q, p);
    const auto rate = [&](const auto& error) {
      return std::log2(approximately(Mpfr(error(end("rkf78", 32)) / error(end("rkf78", 64)))));
    };
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
  const auto rkf = parse_method("rkf78")->make_stepper(scene.problem, SolverKind::automatic),
             hbvm = parse_method("hbvm:12,12")->make_stepper(scene.problem, SolverKind::automatic);
  State<S> state(scene.q0, scene.p0), exact = state;
  const long parts = std::same_as<S, double> ? 64 : std::same_as<S, Quad> ? 8192 : 262144;
  // As long as that takes: sixteen steps.
  const S h = S(1) / S(parts);
  for (int n = 0; n < 16; ++n) {
    rkf->step(state, h);
    hbvm->step(exact, h);
  }
  EXPECT_LE(distance(state.q, exact.q), 64 * epsilon<S>());
}

/// Thirteen a step: what ends a step begins the next.
TEST(Rkf78, CountsItsEvaluations) {
  const Assembled<double> scene = assemble<double>(load_scene("tethered_satellites"));
  const auto rkf = parse_method("rkf78")->make_stepper(scene.problem, SolverKind::automatic);
  State<double> state(scene.q0, scene.p0);
  for (int n = 0; n < 10; ++n) EXPECT_EQ(rkf->step(state, 0.05).sweeps, 1);
  EXPECT_EQ(rkf->counts().effects[0].evaluations, 131U);
}

}  // namespace
}  // namespace hbvm::core
