#include "problem/constraint/displacement_product.hpp"

#include "problem/constraint/form_test.hpp"

namespace hbvm::core {
namespace {

template <class S>
using DisplacementProductTest = FormTest<S>;
TYPED_TEST_SUITE(DisplacementProductTest, AllScalars, ScalarNames);

TYPED_TEST(DisplacementProductTest, AngleBetweenRodsThatShareABody) {
  const Displacement<TypeParam> x{{{0, TypeParam(1)}, {2, TypeParam(-1)}}, {}},
      y{{{6, TypeParam(1)}, {2, TypeParam(-1)}}, {}};
  const Constraint<TypeParam> angle{"angle", DisplacementProduct<TypeParam>{x, y, TypeParam(7)}};
  const auto q = this->vector({1, 2, 3, 5, 0, 0, -4, 1});
  EXPECT_EQ(value(angle, 2, q).g, (1 - 3) * (-4 - 3) + (2 - 5) * (1 - 5) - 7);
  EXPECT_EQ(curvature(angle, 2, q, q), 2 * ((1 - 3) * (-4 - 3) + (2 - 5) * (1 - 5)));
  EXPECT_EQ(coordinates(angle, 2), (std::vector<Index>{0, 1, 2, 3, 6, 7}));
}

}  // namespace
}  // namespace hbvm::core
