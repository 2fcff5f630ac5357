#include "hbvm/problem/constraint/plane.hpp"

#include "problem/constraint/form_test.hpp"

namespace hbvm {
namespace {

template <class S>
using PlaneTest = FormTest<S>;
TYPED_TEST_SUITE(PlaneTest, AllScalars, ScalarNames);

TYPED_TEST(PlaneTest, PlaneIsLinear) {
  const Constraint<TypeParam> plane{"plane", Plane<TypeParam>{3, this->vector({1, 2, -2}), TypeParam(4)}};
  const auto q = this->vector({9, 9, 9, 3, 5, 7});
  EXPECT_EQ(value(plane, 3, q).g, 3 + 10 - 14 - 4);
  EXPECT_EQ(curvature(plane, 3, q, q), 0);
  EXPECT_EQ(coordinates(plane, 3), (std::vector<Index>{3, 4, 5}));
}

}  // namespace
}  // namespace hbvm
