#include "solver/solver_counts.hpp"

#include <gtest/gtest.h>

#include "scene/assemble.hpp"

namespace hbvm::core {
namespace {

PartCount part(const char* name, std::uint64_t calls, Index adds, bool in_double = false) {
  PartCount result{name, calls};
  result.per_call.add(Op::add, adds);
  result.seconds = static_cast<double>(calls);
  result.in_double = in_double;
  return result;
}

/// Calls of parts are added where they cost the same, in whatever order the solvers name them.
TEST(SolverCounts, AddCallsOfTheSamePart) {
  const Assembled<double> scene = assemble<double>(load_scene("kepler"));
  const std::vector<EffectCount> effects(scene.problem.potential.terms.size());
  SolverCounts sum{effects, {part("a", 1, 5), part("b", 2, 5)}};
  add_counts(sum, {effects, {part("c", 8, 5), part("b", 4, 5), part("a", 16, 6), part("a", 32, 5, true)}},
             scene.problem);
  ASSERT_EQ(sum.parts.size(), 5u);
  EXPECT_EQ(sum.parts[0].calls, 1u);
  EXPECT_EQ(sum.parts[1].calls, 6u);
  EXPECT_EQ(sum.parts[1].seconds, 6);
  EXPECT_EQ(sum.parts[2].name, "c");
  EXPECT_EQ(sum.parts[3].calls, 16u) << "of another size";
  EXPECT_TRUE(sum.parts[4].in_double);
}

TEST(SolverCounts, OfNothingChangeNone) {
  const Assembled<double> scene = assemble<double>(load_scene("kepler"));
  const std::vector<EffectCount> effects(scene.problem.potential.terms.size());
  const SolverCounts some{effects, {part("a", 1, 5)}};
  for (const SolverCounts& sum : {sum_of({}, some, scene.problem), sum_of(some, {}, scene.problem)}) {
    EXPECT_EQ(sum.effects.size(), effects.size());
    ASSERT_EQ(sum.parts.size(), 1u);
    EXPECT_EQ(sum.parts[0].calls, 1u);
  }
}

TEST(SolverCounts, OfEffectsAreAddedButForConstantForces) {
  const Assembled<double> scene = assemble<double>(load_scene("modified_pendulum"));
  std::vector<EffectCount> effects(scene.problem.potential.terms.size());
  for (EffectCount& effect : effects) effect.calls = effect.evaluations = 3;
  const SolverCounts one{effects, {part("a", 1, 5)}}, sum = sum_of(one, one, scene.problem);
  for (std::size_t t = 0; t < effects.size(); ++t)
    EXPECT_EQ(sum.effects[t].calls, scene.problem.potential.terms[t].constant_force ? 3u : 6u) << t;
}

}  // namespace
}  // namespace hbvm::core
