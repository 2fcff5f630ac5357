#include "problem/driven_point.hpp"

#include "printing.hpp"
#include "problem/effect/execution.hpp"

namespace hbvm::core {
namespace {

template <class S>
class DrivenPointTest : public InDigits<40> {};
TYPED_TEST_SUITE(DrivenPointTest, AllScalars, ScalarNames);

TYPED_TEST(DrivenPointTest, OfAClockIsTheTime) {
  using S = TypeParam;
  const DrivenPoint<S> clock = clock_point<S>("t", 3);
  const S t = S(7) / 4;
  Matrix<S> expected = Matrix<S>::Zero(1, 9);
  expected(0, 0) = t;
  expected(0, 3) = 1;
  EXPECT_EQ(outputs_of(clock.course, Matrix<S>(1, 0), Matrix<S>(Matrix<S>::Constant(1, 1, t))), expected);
  EXPECT_EQ(in_double(clock).name, "t");
}

}  // namespace
}  // namespace hbvm::core
