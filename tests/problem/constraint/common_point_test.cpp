#include "problem/constraint/common_point.hpp"

#include "problem/constraint/form_test.hpp"

namespace hbvm::core {
namespace {

template <class S>
using CommonPointTest = FormTest<S>;
TYPED_TEST_SUITE(CommonPointTest, AllScalars, ScalarNames);

TYPED_TEST(CommonPointTest, IsAComponentOfADisplacement) {
  using S = TypeParam;
  const Displacement<S> x{{{0, S(1)}, {4, S(-3)}}, this->vector({5, 7})};
  const auto q = this->vector({1, 2, 9, 9, 3, 4});
  const auto parts = CommonPoint<S>::of(x, 2);
  ASSERT_EQ(parts.size(), 2u);
  const Constraint<S> first{parts[0].first, std::get<0>(parts[0].second)},
      second{parts[1].first, std::get<0>(parts[1].second)};
  EXPECT_EQ(first.name, "point, x");
  EXPECT_EQ(second.name, "point, y");
  EXPECT_EQ(value(first, 2, q).g, 1 - 9 + 5);
  EXPECT_EQ(value(second, 2, q).g, 2 - 12 + 7);
  EXPECT_EQ(value(second, 2, q).size, 2 + 12 + 7);
  EXPECT_EQ(curvature(second, 2, q, q), 0);
  EXPECT_EQ(coordinates(first, 2), (std::vector<Index>{0, 4}));
  EXPECT_EQ(coordinates(second, 2), (std::vector<Index>{1, 5}));
}

}  // namespace
}  // namespace hbvm::core
