#include "problem/constraint/quadric.hpp"

#include "problem/constraint/form_test.hpp"

namespace hbvm::core {
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

/// Of the point 2 a - b + (1, 5): x = 2 a_x - b_x + 1, y = 2 a_y - b_y + 5.
TYPED_TEST(QuadricTest, OfASumOfBlocks) {
  Matrix<TypeParam> A(2, 2);
  A << TypeParam(2), TypeParam(-1), TypeParam(-1), TypeParam(3);
  const Displacement<TypeParam> sum{{{2, TypeParam(2)}, {6, TypeParam(-1)}}, this->vector({1, 5})};
  const Constraint<TypeParam> quadric{"quadric", Quadric<TypeParam>::of(sum, A, this->vector({4, -5}), TypeParam(6))};
  const auto q = this->vector({9, 9, 3, 5, 9, 9, -2, 1});
  const int x = 6 + 2 + 1, y = 10 - 1 + 5;
  EXPECT_EQ(value(quadric, 2, q).g, 2 * x * x - 2 * x * y + 3 * y * y + 4 * x - 5 * y + 6);
  // Of velocities (2 3 + 2, 2 5 - 1) of the point.
  EXPECT_EQ(curvature(quadric, 2, q, q), 2 * (2 * 8 * 8 - 2 * 8 * 9 + 3 * 9 * 9));
  EXPECT_EQ(coordinates(quadric, 2), (std::vector<Index>{2, 3, 6, 7}));
}

}  // namespace
}  // namespace hbvm::core
