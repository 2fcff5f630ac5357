#include "method/decimals.hpp"

#include "method/tableaux.hpp"

namespace hbvm::core {
namespace {

/// One stage with this b.
std::optional<Decimals> decimals_with(const std::string& b) { return decimals_of(tableau({{"1/2"}}, {b}, {"1/2"})); }

TEST(Decimals, AreWhatIsRounded) {
  for (const char* exact : {"1", "1/3", "0.5", "0.125", "sqrt(3)/6", "0.0009765625", "12345678/3", "2.5e-3"})
    EXPECT_FALSE(decimals_with(exact)) << exact;
  const auto third = decimals_with("0.333333333333");
  ASSERT_TRUE(third);
  EXPECT_EQ(third->digits, 12);
  EXPECT_EQ(third->example, "0.333333333333");
  EXPECT_EQ(third->fraction, "1/3");
  const auto root = decimals_with("0.28867513459481288225457439025098");
  ASSERT_TRUE(root);
  EXPECT_EQ(root->digits, 32);
  EXPECT_FALSE(root->fraction);
  EXPECT_EQ(decimals_with("0.16666666666666666")->digits, 16 + 1 - 1) << "what a double prints has 16";
}

/// Of numbers with as many places those below 1 tell the digits, and what is exact is no example.
TEST(Decimals, OfEqualPlaces) {
  const auto found = decimals_of(tableau({{"0.2000000000", "9.8228928517"}, {"2.8461538462", "11.5957933242"}},
                                         {"0.5000000000", "0.4492362983"}, {"0.8888888889", "1.0000000000"}));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->digits, 10);
  EXPECT_EQ(found->example, "2.8461538462");
  EXPECT_EQ(found->fraction, "37/13");
  const auto great = decimals_of(tableau({{"9.8228928517"}}, {"1"}, {"2.8461538462"}));
  ASSERT_TRUE(great);
  EXPECT_EQ(great->digits, 11);
}

TEST(Decimals, HaveTheDigitsThatAreSaid) {
  Tableau said = tableau({{"1/2"}}, {"0.25"}, {"1/2"});
  EXPECT_FALSE(decimals_of(said));
  said.digits = 7;
  ASSERT_TRUE(decimals_of(said));
  EXPECT_EQ(decimals_of(said)->digits, 7);
}

/// Only decimals move, by a unit of their last digit.
TEST(Decimals, AreOffByAUnit) {
  const PrecisionScope scope(40);
  const Tableau given = tableau({{"1/2"}}, {"0.333333333333"}, {"1/2"});
  const Decimals decimals = *decimals_of(given);
  const RungeKutta<Mpfr> right = make_runge_kutta<Mpfr>(given);
  for (const unsigned pattern : {1U, 2U}) {
    const RungeKutta<Mpfr> off = off_by_a_unit(given, decimals, pattern);
    EXPECT_EQ(off.A(0, 0), right.A(0, 0));
    EXPECT_EQ(off.c[0], right.c[0]);
    const Mpfr change = magnitude(Mpfr(off.b[0] - right.b[0]));
    EXPECT_LE(magnitude(Mpfr(change - literal<Mpfr>("1e-12"))), literal<Mpfr>("1e-38"));
  }
}

}  // namespace
}  // namespace hbvm::core
