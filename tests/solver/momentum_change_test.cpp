#include "solver/momentum_change.hpp"

#include "printing.hpp"
#include "scalar/random_values.hpp"

namespace hbvm::core {
namespace {

template <class S>
class MomentumChangeTest : public InDigits<50> {};
TYPED_TEST_SUITE(MomentumChangeTest, AllScalars, ScalarNames);

/// With residual = X_s y and correction = X_s z the change is row 0 of y - z.
TYPED_TEST(MomentumChangeTest, IsThatOfTheFirstCoefficient) {
  using S = TypeParam;
  const Hbvm<S> method = make_hbvm<S>(3, 3);
  RandomValues<S> random(67);
  constexpr Index m = 2;
  const Matrix<S> y = random.matrix(3, m), z = random.matrix(3, m);
  const Vector<S> before = random.vector(m);
  Vector<S> change = before;
  MomentumChange<S>(method).add(method.X_s.lazyProduct(y), method.X_s.lazyProduct(z), change);
  for (Index j = 0; j < m; ++j)
    EXPECT_LE(magnitude(S(change[j] - before[j] - (y(0, j) - z(0, j)))), 256 * epsilon<S>()) << j;
}

}  // namespace
}  // namespace hbvm::core
