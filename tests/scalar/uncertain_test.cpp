#include "scalar/uncertain.hpp"

#include "printing.hpp"
#include "scalar/random_values.hpp"

namespace hbvm::core {
namespace {

/// Two numbers and all that lies within their errors.
class UncertainTest : public InDigits<40> {
 protected:
  RandomValues<Mpfr> random{37};

  Uncertain any() {
    const Mpfr value = random.value();
    return {value, Mpfr(magnitude(value) * magnitude(random.value()) / 4)};
  }
  /// The ends and something between.
  std::vector<Mpfr> within(const Uncertain& x) {
    return {Mpfr(x.value - x.error), Mpfr(x.value + x.error), Mpfr(x.value + random.value() * x.error)};
  }
};

TEST_F(UncertainTest, ResultsHoldThoseOfAllThatIsWithin) {
  const Mpfr slack = 4 * epsilon<Mpfr>();
  for (int n = 0; n < 200; ++n) {
    const Uncertain a = any(), b = any();
    const Uncertain sum = a + b, difference = a - b, product = a * b, quotient = a / b, negative = -a;
    const auto holds = [&](const Uncertain& x, const Mpfr& true_one) {
      return magnitude(Mpfr(x.value - true_one)) <= x.error + slack * (1 + magnitude(true_one));
    };
    for (const Mpfr& x : within(a)) {
      EXPECT_TRUE(holds(negative, Mpfr(-x)));
      for (const Mpfr& y : within(b)) {
        EXPECT_TRUE(holds(sum, Mpfr(x + y)));
        EXPECT_TRUE(holds(difference, Mpfr(x - y)));
        EXPECT_TRUE(holds(product, Mpfr(x * y)));
        EXPECT_TRUE(holds(quotient, Mpfr(x / y))) << a.value << " " << b.value;
      }
    }
  }
}

/// The bounds are attained: of a sum, a product, and a quotient by hand.
TEST_F(UncertainTest, ErrorsAreNoLargerThanNeeded) {
  const Uncertain a(3, Mpfr(1) / 4), b(-2, Mpfr(1) / 8);
  const auto near = [](const Mpfr& x, const Mpfr& y) { return magnitude(Mpfr(x - y)) <= 16 * epsilon<Mpfr>(); };
  EXPECT_TRUE(near((a + b).error, Mpfr(3) / 8));
  EXPECT_TRUE(near((a - b).error, Mpfr(3) / 8));
  EXPECT_TRUE(near((a * b).error, Mpfr(13 * 17 - 12 * 16) / 32));  // |3 1/4 * -2 1/8| - 6
  EXPECT_TRUE(near((a / b).error, Mpfr(Mpfr(13) / 4 / (Mpfr(15) / 8) - Mpfr(3) / 2)));
}

TEST_F(UncertainTest, RoundingsAreErrorsToo) {
  const Uncertain third = Uncertain(1) / Uncertain(3);
  EXPECT_GT(third.error, 0);
  EXPECT_LE(magnitude(Mpfr(1 - 3 * third.value)), 3 * third.error);
  EXPECT_TRUE((third + third + third - Uncertain(1)).holds_zero());
  EXPECT_EQ(Uncertain(5).error, 0);
}

TEST_F(UncertainTest, HoldsZeroIfTheErrorReachesIt) {
  EXPECT_TRUE(Uncertain().holds_zero());
  EXPECT_TRUE(Uncertain(-1, 1).holds_zero());
  EXPECT_FALSE(Uncertain(-1, Mpfr(1 - epsilon<Mpfr>())).holds_zero());
  EXPECT_FALSE(Uncertain(1).holds_zero());
}

}  // namespace
}  // namespace hbvm::core
