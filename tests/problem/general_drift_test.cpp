#include "problem/general_drift.hpp"

#include "printing.hpp"
#include "scene/assemble.hpp"

namespace hbvm::core {
namespace {

template <class S>
class GeneralDriftTest : public InDigits<50> {};
TYPED_TEST_SUITE(GeneralDriftTest, AllScalars, ScalarNames);

TYPED_TEST(GeneralDriftTest, LooksAtConstraintsThatAreNotQuadratic) {
  using S = TypeParam;
  for (const char* name : {"double_pendulum", "bead_on_ellipsoid", "heavy_top", "kepler"})
    EXPECT_TRUE(GeneralDrift<S>(assemble<S>(load_scene(name)).problem).empty()) << name;
  // Of the three of this scene one is a rod.
  const Assembled<S> scene = assemble<S>(load_scene("rod_on_two_curves"));
  GeneralDrift<S> drift(scene.problem);
  EXPECT_FALSE(drift.empty());
  Vector<S> q = scene.q0;
  drift.start(q);
  EXPECT_EQ(drift.in_units(q), 0);
  q[2] += 1;  // along the tangent of the upper curve: the rod alone is longer at first
  q[3] = 1 + (exp(S(1)) + exp(S(-1))) / 2;
  EXPECT_LE(drift.in_units(q), 2);
}

/// The same motion in other units has the same drift, and a rounding of q is about one unit.
TYPED_TEST(GeneralDriftTest, IsMeasuredInRoundings) {
  using S = TypeParam;
  const Assembled<S> scene = assemble<S>(load_scene("bead_on_torus"));
  GeneralDrift<S> drift(scene.problem);
  drift.start(scene.q0);
  Vector<S> q = scene.q0;
  q[0] *= 1 + 8 * epsilon<S>();
  const S few = drift.in_units(q);
  EXPECT_GT(few, S(1) / 64);
  EXPECT_LE(few, 8);
  q[0] = scene.q0[0] * (1 + 8'192 * epsilon<S>());
  EXPECT_LE(magnitude(S(drift.in_units(q) / few - 1'024)), 256);
}

TYPED_TEST(GeneralDriftTest, OfWhatIsNotFiniteIsNot) {
  using S = TypeParam;
  const Assembled<S> scene = assemble<S>(load_scene("bead_on_cycloid"));
  GeneralDrift<S> drift(scene.problem);
  drift.start(scene.q0);
  Vector<S> q = scene.q0;
  q[2] = 2;  // beyond the end of the wire
  EXPECT_FALSE(drift.in_units(q) <= 1'000'000);
}

}  // namespace
}  // namespace hbvm::core
