#include "scene/turning.hpp"

#include "printing.hpp"

namespace hbvm::core {
namespace {

template <class S>
class Turning : public InDigits<40> {};
TYPED_TEST_SUITE(Turning, AllScalars, ScalarNames);

/// Directors along the axes of space that turn at omega, after a coordinate that is none of theirs.
TYPED_TEST(Turning, HasTheAngularVelocityOfItsDirectors) {
  using S = TypeParam;
  for (const Index d : {Index{2}, Index{3}}) {
    Vector<S> omega(d == 2 ? 1 : 3), q = Vector<S>::Zero(1 + d * d), v = q;
    for (Index i = 0; i < omega.size(); ++i) omega[i] = S(i + 2) / 4;
    for (Index a = 0; a < d; ++a) {
      q[1 + d * a + a] = 1;
      v.segment(1 + d * a, d) = turned(omega, Vector<S>(Vector<S>::Unit(d, a)));
    }
    EXPECT_EQ(angular_velocity(d, 1, q, v), omega);
  }
}

/// y turns towards -x, x towards y.
TYPED_TEST(Turning, IsCounterclockwiseInThePlane) {
  using S = TypeParam;
  const Vector<S> omega = Vector<S>::Constant(1, S(3));
  EXPECT_EQ(turned(omega, Vector<S>(Vector<S>::Unit(2, 0))), Vector<S>(3 * Vector<S>::Unit(2, 1)));
  EXPECT_EQ(turned(omega, Vector<S>(Vector<S>::Unit(2, 1))), Vector<S>(-3 * Vector<S>::Unit(2, 0)));
}

}  // namespace
}  // namespace hbvm::core
