#include "method/radau.hpp"

#include <cmath>

#include "hbvm/error.hpp"
#include "method/order_conditions.hpp"
#include "printing.hpp"

namespace hbvm::core {
namespace {

template <class S>
class RadauTest : public InDigits<50> {};
TYPED_TEST_SUITE(RadauTest, AllScalars, ScalarNames);

/// Hairer, Wanner: table IV.5.6, s = 3.
TYPED_TEST(RadauTest, CoefficientsOfThreeStages) {
  using S = TypeParam;
  using std::sqrt;
  const RungeKutta<S> method = radau<S>(3);
  const S r = sqrt(S(6));
  const S A[3][3] = {{(88 - 7 * r) / 360, (296 - 169 * r) / 1800, (-2 + 3 * r) / 225},
                     {(296 + 169 * r) / 1800, (88 + 7 * r) / 360, (-2 - 3 * r) / 225},
                     {(16 - r) / 36, (16 + r) / 36, S(1) / 9}};
  const S c[3] = {(4 - r) / 10, (4 + r) / 10, 1};
  for (Index i = 0; i < 3; ++i) {
    EXPECT_LE(magnitude(S(method.c[i] - c[i])), 2 * epsilon<S>());
    EXPECT_EQ(method.b[i], method.A(2, i));
    for (Index j = 0; j < 3; ++j) EXPECT_LE(magnitude(S(method.A(i, j) - A[i][j])), 2 * epsilon<S>()) << i << j;
  }
}

/// B(2s - 1), C(s), D(s - 1), and no more: the order is 2s - 1 (Hairer, Wanner, theorem IV.5.3).
TYPED_TEST(RadauTest, CoefficientsMeetTheirConditions) {
  using S = TypeParam;
  for (const int s : {1, 2, 5, 9, 40}) {
    const RungeKutta<S> method = radau<S>(s);
    const S tolerance = 4 * S(s) * epsilon<S>();
    EXPECT_LE(condition_B(method, 2 * s - 1), tolerance) << s;
    EXPECT_LE(condition_C(method, s), tolerance) << s;
    EXPECT_LE(condition_D(method, s - 1), tolerance) << s;
    if (s < 9) {
      EXPECT_GT(condition_B(method, 2 * s), 1'000 * tolerance) << s;
    }
    EXPECT_EQ(method.c[s - 1], 1);
    for (Index i = 1; i < s; ++i) EXPECT_LT(method.c[i - 1], method.c[i]) << s;
  }
}

TEST(Radau, RefusesWhatIsNoNumberOfStages) {
  for (const int s : {0, -1, 201}) EXPECT_THROW(radau<double>(s), InputError) << s;
}

}  // namespace
}  // namespace hbvm::core
