#include "problem/constraint/plane.hpp"

#include "problem/constraint/form_test.hpp"

namespace hbvm::core {
namespace {

template <class S>
using PlaneTest = FormTest<S>;
TYPED_TEST_SUITE(PlaneTest, AllScalars, ScalarNames);

TYPED_TEST(PlaneTest, PlaneIsLinear) {
  const Constraint<TypeParam> plane{"plane", Plane<TypeParam>{{3}, this->vector({1, 2, -2}), TypeParam(4)}};
  const auto q = this->vector({9, 9, 9, 3, 5, 7});
  EXPECT_EQ(value(plane, 3, q).g, 3 + 10 - 14 - 4);
  EXPECT_EQ(curvature(plane, 3, q, q), 0);
  EXPECT_EQ(coordinates(plane, 3), (std::vector<Index>{3, 4, 5}));
}

/// Of the point 2 d1 - d2 + (1, 5) of a body that turns about a fixed point.
TYPED_TEST(PlaneTest, OfASumOfBlocks) {
  const Displacement<TypeParam> x{{{2, TypeParam(2)}, {6, TypeParam(-1)}}, this->vector({1, 5})};
  const auto form = Plane<TypeParam>::of(x, this->vector({3, 1}), TypeParam(4));
  const Constraint<TypeParam> plane{"plane", form};
  const auto q = this->vector({9, 9, 3, 5, 9, 9, -2, 1});
  EXPECT_EQ(value(plane, 2, q).g, 3 * (6 + 2 + 1) + (10 - 1 + 5) - 4);
  EXPECT_EQ(curvature(plane, 2, q, q), 0);
  EXPECT_EQ(coordinates(plane, 2), (std::vector<Index>{2, 3, 6, 7}));
}

}  // namespace
}  // namespace hbvm::core
