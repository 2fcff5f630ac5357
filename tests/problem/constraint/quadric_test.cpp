#include "hbvm/problem/constraint/quadric.hpp"

#include "problem/constraint/form_test.hpp"

namespace hbvm {
namespace {

template <class S>
using QuadricTest = FormTest<S>;
TYPED_TEST_SUITE(QuadricTest, AllScalars, ScalarNames);

TYPED_TEST(QuadricTest, QuadricWithALinearPart) {
  Matrix<TypeParam> A(2, 2);
  A << TypeParam(2), TypeParam(-1), TypeParam(-1), TypeParam(3);
  const Constraint<TypeParam> quadric{"quadric", Quadric<TypeParam>{{2}, A, this->vector({4, -5}), TypeParam(6)}};
  const auto q = this->vector({9, 9, 1, -2});
  EXPECT_EQ(value(quadric, 2, q).g, 2 * 1 - 2 * (-2) + 3 * 4 + 4 * 1 - 5 * (-2) + 6);
  EXPECT_EQ(curvature(quadric, 2, q, q), 2 * (2 * 1 - 2 * (-2) + 3 * 4));
  EXPECT_EQ(coordinates(quadric, 2), (std::vector<Index>{2, 3}));
}

/// Of two bodies, the second before the first one's neighbour.
TYPED_TEST(QuadricTest, OfSeveralBodies) {
  Matrix<TypeParam> A = Matrix<TypeParam>::Zero(4, 4);
  A(0, 3) = A(3, 0) = 2;
  A(1, 1) = 5;
  const Constraint<TypeParam> quadric{"quadric",
                                      Quadric<TypeParam>{{0, 4}, A, this->vector({0, 1, 3, 0}), TypeParam(-7)}};
  const auto q = this->vector({2, 3, 9, 9, 5, -2});
  EXPECT_EQ(value(quadric, 2, q).g, 2 * 2 * 2 * (-2) + 5 * 3 * 3 + 3 + 3 * 5 - 7);
  EXPECT_EQ(curvature(quadric, 2, q, q), 2 * (2 * 2 * 2 * (-2) + 5 * 3 * 3));
  EXPECT_EQ(coordinates(quadric, 2), (std::vector<Index>{0, 1, 4, 5}));
}

}  // namespace
}  // namespace hbvm
