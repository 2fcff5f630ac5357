#include "method/known_tableaux.hpp"

#include "method/tableaux.hpp"

namespace hbvm::core {
namespace {

template <class S>
using KnownTableaux = TableauTest<S>;
TYPED_TEST_SUITE(KnownTableaux, AllScalars, ScalarNames);

TYPED_TEST(KnownTableaux, HaveTheStatedOrderAndNoMore) {
  for (const KnownTableau& known : known_tableaux()) {
    EXPECT_EQ(this->order_of(known.tableau), known.tableau.order) << known.name;
    this->expect_zero(condition_C(make_runge_kutta<TypeParam>(known.tableau), 1), "row sums", 1);
  }
}

/// Explicit below the diagonal alone; SDIRK with one number on it.
TYPED_TEST(KnownTableaux, SolveNoStageWithALaterOne) {
  for (const KnownTableau& known : known_tableaux()) {
    const RungeKutta<TypeParam> method = make_runge_kutta<TypeParam>(known.tableau);
    const bool implicit = known.name.starts_with("sdirk");
    EXPECT_EQ(method.A(0, 0) != 0, implicit) << known.name;
    for (Index i = 0; i < method.stages(); ++i)
      for (Index j = i; j < method.stages(); ++j) EXPECT_EQ(method.A(i, j), j == i ? method.A(0, 0) : 0) << known.name;
  }
}

/// The last stage is the end of the step, so that R(infinity) = 0 (Hairer, Wanner, proposition IV.3.8).
TYPED_TEST(KnownTableaux, SdirkEndsWithItsLastStage) {
  for (const char* const name : {"sdirk:2", "sdirk:3", "sdirk:5"}) {
    const RungeKutta<TypeParam> method = make_runge_kutta<TypeParam>(known(name));
    for (Index j = 0; j < method.stages(); ++j) EXPECT_EQ(method.A(method.stages() - 1, j), method.b[j]) << name;
  }
}

/// A-stable with its gamma: of three stages it is the root of x^3 - 3 x^2 + 3/2 x - 1/6 between 1/6 and 1/2, table
/// IV.6.3.
TYPED_TEST(KnownTableaux, GammaOfSdirkIsTheStableOne) {
  using S = TypeParam;
  const S two = make_runge_kutta<S>(known("sdirk:2")).A(0, 0), x = make_runge_kutta<S>(known("sdirk:3")).A(0, 0);
  EXPECT_LE(magnitude(S(two * two - 2 * two + S(1) / 2)), epsilon<S>());
  EXPECT_LT(two, S(1) / 2);
  EXPECT_LE(magnitude(S(((x - 3) * x + S(3) / 2) * x - S(1) / 6)), epsilon<S>());
  EXPECT_LE(magnitude(S(x - literal<S>("0.435866521508458999"))), literal<S>("1e-15"));
}

}  // namespace
}  // namespace hbvm::core
