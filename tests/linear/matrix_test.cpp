#include "linear/matrix.hpp"

#include "printing.hpp"

namespace hbvm::core {
namespace {

template <class S>
class MaxNorm : public InDigits<50> {};
TYPED_TEST_SUITE(MaxNorm, AllScalars, ScalarNames);

TYPED_TEST(MaxNorm, IsTheLargestMagnitude) {
  Matrix<TypeParam> a(2, 3);
  a << TypeParam(1), TypeParam(-7), TypeParam(3), TypeParam(0), TypeParam(6), TypeParam(-2);
  EXPECT_EQ(max_norm(a), 7);
  Vector<TypeParam> v(3);
  v << TypeParam(-1), TypeParam(-2), TypeParam(1);
  EXPECT_EQ(max_norm(v), 2);
}

TYPED_TEST(MaxNorm, OfNothingIsZero) {
  EXPECT_EQ(max_norm(Matrix<TypeParam>(0, 3)), 0);
  EXPECT_EQ(max_norm(Vector<TypeParam>(0)), 0);
}

TYPED_TEST(MaxNorm, ShowsANaNWhereverItStands) {
  for (int at = 0; at < 4; ++at) {
    Matrix<TypeParam> a = Matrix<TypeParam>::Constant(2, 2, TypeParam(5));
    a.data()[at] = std::numeric_limits<TypeParam>::quiet_NaN();
    const TypeParam norm = max_norm(a);
    EXPECT_NE(norm, norm) << at;
  }
}

}  // namespace
}  // namespace hbvm::core
