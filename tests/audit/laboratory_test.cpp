#include "audit/laboratory.hpp"

#include "audit/claim_groups.hpp"
#include "printing.hpp"

namespace hbvm::core {
namespace {

class LaboratoryTest : public InDigits<40> {
 protected:
  const Mpfr small = 1'000'000 * epsilon<Mpfr>();
};

/// From each start on, one way there and back; no motion is known that has no closed form.
TEST_F(LaboratoryTest, KnowsMotionsInClosedForm) {
  ClaimGroup group = group_of("simple_pendulum", {2, 2}, {Quantity::q});
  group.log2_scale = -1;
  group.starts.count = 3;
  const Laboratory laboratory(group);
  ASSERT_EQ(laboratory.starts().size(), 3u);
  for (const Laboratory::Start& start : laboratory.starts()) {
    const auto known = laboratory.known(start, Mpfr(2));
    ASSERT_TRUE(known);
    EXPECT_GT(distance(known->q, start.q), Mpfr(1) / 10);
    const auto back = laboratory.known({known->q, known->p}, Mpfr(-2));
    ASSERT_TRUE(back);
    EXPECT_LE(distance(back->q, start.q), small);
    EXPECT_LE(distance(back->p, start.p), small);
  }
  group = group_of("double_pendulum", {2, 2}, {Quantity::q});
  const Laboratory other(group);
  EXPECT_FALSE(other.known(other.starts()[0], Mpfr(1)));
}

/// On the motion one after the other: consistent, of the scene's energy, and where the stride says.
TEST_F(LaboratoryTest, StartsAreConsistentStatesOfTheMotion) {
  ClaimGroup group = group_of("double_pendulum", {2, 2}, {Quantity::q});
  group.log2_scale = -2;
  group.starts = {3, 2, 1};
  Laboratory laboratory(group);
  const Assembled<Mpfr> scene = assemble<Mpfr>(load_scene("double_pendulum"));
  StateEvaluator<Mpfr>& point = laboratory.point();
  const Mpfr energy = point.energy(scene.q0, scene.p0);
  ASSERT_EQ(laboratory.starts().size(), 3u);
  for (const Laboratory::Start& start : laboratory.starts()) {
    EXPECT_LE(max_norm(point.constraints(start.q)), small);
    EXPECT_LE(max_norm(point.hidden_constraints(start.q, start.p)), small);
    EXPECT_LE(magnitude(Mpfr(point.energy(start.q, start.p) - energy)), ldexp(Mpfr(1), -20));
  }
  group.starts = {1, 4, 1};
  EXPECT_EQ(Laboratory(group).starts()[0].q, laboratory.starts()[2].q);
  group.starts = {2, 2, 2};
  EXPECT_EQ(Laboratory(group).starts()[1].p, laboratory.starts()[2].p);
  EXPECT_NE(laboratory.starts()[0].q, laboratory.starts()[1].q);
}

TEST_F(LaboratoryTest, KeepsToTheTimeThereIs) {
  ClaimGroup group = group_of("double_pendulum", {2, 2}, {Quantity::q});
  group.stop_at = 1 / double{1'000'000'000};
  EXPECT_THROW(Laboratory{group}, LimitReached);
}

}  // namespace
}  // namespace hbvm::core
