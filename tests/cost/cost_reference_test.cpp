#include "cost/cost_reference.hpp"

#include <gtest/gtest.h>

namespace hbvm::core {
namespace {

TEST(CostReference, IsAShippedOneWhereThatHasTheDigits) {
  const Scene scene = load_scene("kepler");
  // However the time is written.
  for (const char* const until : {"10", "20/2"}) {
    const CostReference found = find_cost_reference({.scene = &scene, .until = Expression::parse(until), .digits = 50});
    EXPECT_EQ(found.source, "shipped: kepler_t10_50");
    EXPECT_EQ(found.digits, 50);
  }
}

TEST(CostReference, IsNotOneOfAnotherScene) {
  Scene scene = load_scene("kepler");
  scene.bodies.front().mass = Expression::parse("2");
  const CostReference found =
      find_cost_reference({.scene = &scene, .until = Expression::parse("10"), .digits = 12, .confirmed = false});
  EXPECT_TRUE(found.source.starts_with("Taylor series")) << found.source;
}

TEST(CostReference, IsKeptWithWhatWasComputed) {
  const Scene scene = load_scene("simple_pendulum");
  CellStore store;
  const Expression until = Expression::parse("1/2");
  const CostReferenceRequest request{.scene = &scene, .until = until, .digits = 25, .store = &store};
  const CostReference computed = find_cost_reference(request);
  CostReferenceRequest again = request;
  again.progress = [](double) { FAIL() << "it is computed again"; };
  EXPECT_EQ(find_cost_reference(again).state.q, computed.state.q);
  const MotionNature nature = find_nature(scene, until, &store, {}), known = find_nature(scene, until, &store, {});
  EXPECT_EQ(nature.log2_radius, known.log2_radius);
  EXPECT_EQ(nature.digits_lost, known.digits_lost);
}

}  // namespace
}  // namespace hbvm::core
