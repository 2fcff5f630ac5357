#include "problem/constraint/rod.hpp"

#include "problem/constraint/form_test.hpp"

namespace hbvm::core {
namespace {

template <class S>
using RodTest = FormTest<S>;
TYPED_TEST_SUITE(RodTest, AllScalars, ScalarNames);

TYPED_TEST(RodTest, RodBetweenTwoBodies) {
  const Displacement<TypeParam> x{{{0, TypeParam(1)}, {3, TypeParam(-1)}}, {}};
  const Constraint<TypeParam> rod{"rod", Rod<TypeParam>{x, 10}};
  EXPECT_EQ(value(rod, 3, this->vector({1, 2, 3, 4, -2, 5})).g, 9 + 16 + 4 - 10);
  const auto q = this->vector({1, 2, 3, 4, -2, 5});
  EXPECT_EQ(curvature(rod, 3, q, q), 2 * (9 + 16 + 4));
  EXPECT_EQ(coordinates(rod, 3), (std::vector<Index>{0, 1, 2, 3, 4, 5}));
}

TYPED_TEST(RodTest, PinAtAPoint) {
  const Displacement<TypeParam> x{{{2, TypeParam(1)}}, this->vector({-1, 3})};
  const Constraint<TypeParam> pin{"pin", Rod<TypeParam>{x, 5}};
  EXPECT_EQ(value(pin, 2, this->vector({9, 9, 2, 4})).g, 1 + 49 - 5);
  const auto q = this->vector({9, 9, 2, 4});
  EXPECT_EQ(curvature(pin, 2, q, q), 2 * (4 + 16));
  EXPECT_EQ(coordinates(pin, 2), (std::vector<Index>{2, 3}));
}

}  // namespace
}  // namespace hbvm::core
