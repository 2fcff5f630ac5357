#include "cost/cost_errors.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "problem/state_evaluator.hpp"
#include "scalar/text.hpp"

namespace hbvm::core {
namespace {

/// A light and a heavy body on springs far from one another.
Scene uneven_scene() {
  return read_scene(
      "title = \"uneven\"\ndimension = 2\n"
      "[[body]]\nname = \"light\"\nmass = \"1e-12\"\nposition = [\"1e-6\", 0]\nvelocity = [0, \"1e-3\"]\n"
      "[[body]]\nname = \"heavy\"\nmass = \"1e20\"\nposition = [\"1e9\", 0]\nvelocity = [0, 5]\n",
      "uneven");
}

ReferenceState state_of(const Assembled<Mpfr>& scene) {
  ReferenceState state;
  for (Index j = 0; j < scene.q0.size(); ++j) {
    state.q.push_back(to_text(scene.q0[j]));
    state.p.push_back(to_text(scene.p0[j]));
  }
  return state;
}

TEST(CostJudge, ComparesEachBodyWithItsOwn) {
  const Scene scene = uneven_scene();
  const PrecisionScope scope(40);
  const Assembled<Mpfr> start = assemble<Mpfr>(scene);
  const CostJudge judge(scene, state_of(start), 60);
  EXPECT_FALSE(judge.has_multipliers());
  const Vector<Mpfr> none(0);
  Vector<Mpfr> q = start.q0;
  q[0] += q[0] / 1'000;
  const CostErrors light = judge.errors<Mpfr>(q, start.p0, none);
  EXPECT_NEAR(light.q, -3, 1e-9);
  EXPECT_TRUE(std::isnan(light.lambda));
  EXPECT_NEAR(light.of(CostQuantity::all), -3, 1e-9);
  // The other coordinate of the heavy one is 0, and is measured by the first.
  q = start.q0;
  q[3] = 10;
  EXPECT_NEAR(judge.errors<Mpfr>(q, start.p0, none).q, -8, 1e-9);
  Vector<Mpfr> p = start.p0;
  p[1] *= 2;
  EXPECT_NEAR(judge.errors<Mpfr>(start.q0, p, none).of(CostQuantity::p), 0, 1e-9);
}

/// With the state at the end, however much greater it was at the start; what is 0 then with the greatest of its kind.
TEST(CostJudge, ComparesWithTheEnd) {
  const Scene scene = uneven_scene();
  const PrecisionScope scope(40);
  const Assembled<Mpfr> start = assemble<Mpfr>(scene);
  Assembled<Mpfr> end = start;
  end.q0[0] = start.q0[0] / 1'000;
  end.p0.setZero();
  end.p0[3] = 2;
  const CostJudge judge(scene, state_of(end), 60);
  const Vector<Mpfr> none(0);
  Vector<Mpfr> q = end.q0, p = end.p0;
  q[0] *= Mpfr(1) + Mpfr(1) / 100;
  EXPECT_NEAR(judge.errors<Mpfr>(q, p, none).q, -2, 1e-9);
  p[0] = Mpfr(1) / 50;
  EXPECT_NEAR(judge.errors<Mpfr>(end.q0, p, none).p, -2, 1e-9);
}

/// Of a multiplier that falls from 1 to 1e-3, fifteen digits are fifteen of what it is.
TEST(CostJudge, ComparesAMultiplierWithItself) {
  const Scene scene = load_scene("simple_pendulum");
  const PrecisionScope scope(40);
  const Assembled<Mpfr> start = assemble<Mpfr>(scene);
  ReferenceState state = state_of(start);
  state.lambda.push_back("1e-3");
  const CostJudge judge(scene, state, 30);
  const Vector<Mpfr> lambda = Vector<Mpfr>::Constant(1, Mpfr("1e-3") + Mpfr("1e-12"));
  EXPECT_NEAR(judge.errors<Mpfr>(start.q0, start.p0, lambda).lambda, -9, 1e-9);
}

TEST(CostJudge, SeesNoFurtherThanTheReference) {
  const Scene scene = load_scene("simple_pendulum");
  const PrecisionScope scope(40);
  const Assembled<Mpfr> start = assemble<Mpfr>(scene);
  StateEvaluator<Mpfr> point(start.problem);
  const Vector<Mpfr> lambda = point.multiplier(start.q0, start.p0);
  ReferenceState state = state_of(start);
  state.lambda.push_back(to_text(lambda[0]));
  const CostJudge judge(scene, state, 20);
  const CostErrors errors = judge.errors<Mpfr>(start.q0, start.p0, lambda);
  EXPECT_EQ(errors.q, judge.resolution().q);
  EXPECT_LE(errors.q, -19);
  EXPECT_GE(errors.q, -21);
  EXPECT_EQ(errors.lambda, judge.resolution().lambda);
  Vector<Mpfr> broken = start.q0;
  broken[0] = Mpfr("nan");
  EXPECT_EQ(judge.errors<Mpfr>(broken, start.p0, lambda).q, INFINITY);
}

TEST(CostJudge, RefusesAnotherScenesReference) {
  EXPECT_THROW(CostJudge(load_scene("kepler"), ReferenceState{}, 20), InputError);
}

TEST(CostQuantity, HasFourNames) {
  for (const char* const name : {"q", "p", "lambda", "all"}) EXPECT_EQ(name_of(parse_cost_quantity(name)), name);
  EXPECT_THROW(parse_cost_quantity("H"), InputError);
}

}  // namespace
}  // namespace hbvm::core
