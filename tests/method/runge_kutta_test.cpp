#include "method/runge_kutta.hpp"

#include "method/tableaux.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

template <class S>
using RungeKuttaTest = TableauTest<S>;
TYPED_TEST_SUITE(RungeKuttaTest, AllScalars, ScalarNames);

TYPED_TEST(RungeKuttaTest, EntriesAreRoundedOnce) {
  using S = TypeParam;
  const auto method = make_runge_kutta<S>(radau_iia());
  EXPECT_EQ(method.stages(), 2);
  EXPECT_EQ(method.A(0, 0), literal<S>("5/12"));
  EXPECT_EQ(method.A(0, 1), literal<S>("-1/12"));
  EXPECT_EQ(method.A(1, 0), literal<S>("3/4"));
  EXPECT_EQ(method.b[1], literal<S>("1/4"));
  EXPECT_EQ(method.c[0], literal<S>("1/3"));
}

TYPED_TEST(RungeKuttaTest, NamesTheEntryWithoutAValue) {
  const auto refusal = [](const Tableau& t) { return message_of([&] { make_runge_kutta<TypeParam>(t); }); };
  EXPECT_TRUE(refusal(tableau({{"0", "0"}, {"1/0", "0"}}, {"1", "0"}, {"0", "0"})).starts_with("A[2][1] "));
  EXPECT_TRUE(refusal(tableau({{"0"}}, {"sqrt(-1)"}, {"0"})).starts_with("b[1] "));
  EXPECT_TRUE(refusal(tableau({{"0"}}, {"1"}, {"x"})).starts_with("c[1] "));
  EXPECT_NE(refusal(tableau({}, {}, {})), "");
  EXPECT_NE(refusal(tableau({{"0"}, {"0"}}, {"1"}, {"0"})), "");
  EXPECT_NE(refusal(tableau({{"0", "0"}, {"0"}}, {"1", "0"}, {"0", "0"})), "");
  EXPECT_NE(refusal(tableau({{"0"}}, {"1"}, {})), "");
  EXPECT_NE(refusal(tableau({{"0"}}, {"1"}, {"0", "1"})), "");
}

}  // namespace
}  // namespace hbvm::core
