#include "integrate/time_grid.hpp"

#include "printing.hpp"
#include "scalar/literal.hpp"

namespace hbvm::core {
namespace {

template <Scalar S>
TimeGrid<S> grid(const char* step, const char* until) {
  return TimeGrid<S>(Expression::parse(step), Expression::parse(until));
}

/// What a grid is refused with; empty if it is not.
template <Scalar S>
std::string refusal(const char* step, const char* until) {
  try {
    grid<S>(step, until);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

template <class S>
class TimeGridOf : public InDigits<50> {};
TYPED_TEST_SUITE(TimeGridOf, AllScalars, ScalarNames);

TYPED_TEST(TimeGridOf, HasRoundedQuotientSteps) {
  using S = TypeParam;
  EXPECT_EQ(grid<S>("0.1", "1000").steps(), 10'000);
  EXPECT_EQ(grid<S>("1/3", "1").steps(), 3);
  EXPECT_EQ(grid<S>("7", "7").steps(), 1);
  EXPECT_EQ(grid<S>("2^(3/4)*pi/40", "2^(3/4)*pi").steps(), 40);
  EXPECT_EQ(grid<S>("sqrt(2)/1000", "sqrt(2)*17").steps(), 17'000);
}

TYPED_TEST(TimeGridOf, TimesAreQuotientsNotSums) {
  using S = TypeParam;
  const TimeGrid<S> times = grid<S>("0.1", "1000");
  for (long n = 0; n <= times.steps(); ++n) {
    const S exact = literal<S>("1000*" + std::to_string(n) + "/10000");
    // 1000 n is exact, and so the quotient is rounded once: 3 x 0.1 would be another number than 0.3.
    EXPECT_EQ(times.time(n), exact) << n;
  }
}

TYPED_TEST(TimeGridOf, FirstIsZeroAndLastIsExactlyUntil) {
  using S = TypeParam;
  for (const char* until : {"1/3", "pi", "1000", "1e-30", "1e30"}) {
    const std::string step = std::string("(") + until + ")/49";
    const TimeGrid<S> times = grid<S>(step.c_str(), until);
    EXPECT_EQ(times.steps(), 49);
    EXPECT_EQ(times.time(0), 0);
    EXPECT_EQ(times.time(49), literal<S>(until));
    EXPECT_EQ(times.until(), literal<S>(until));
    EXPECT_EQ(times.step(), literal<S>(step));
  }
}

TYPED_TEST(TimeGridOf, AcceptsAMissOfFourEpsilonUntil) {
  using S = TypeParam;
  const int bits = significand_bits<S>() - 1;
  const auto until = [&](int epsilons) { return "1 + " + std::to_string(epsilons) + "/2^" + std::to_string(bits); };
  for (const int epsilons : {-3, -1, 0, 1, 4}) EXPECT_EQ(refusal<S>("1", until(epsilons).c_str()), "") << epsilons;
  for (const int epsilons : {-5, 5, 6, 100}) {
    const std::string message = refusal<S>("1", until(epsilons).c_str());
    EXPECT_NE(message.find("does not divide"), std::string::npos) << epsilons << ": " << message;
  }
}

TYPED_TEST(TimeGridOf, RefusesAStepThatDoesNotDivide) {
  using S = TypeParam;
  for (const auto& [step, until] : std::vector<std::pair<const char*, const char*>>{
           {"0.3", "1"}, {"2", "1"}, {"2", "3"}, {"1e300", "1"}, {"3", "1"}, {"0.1", "0.25"}, {"1/3", "0.3333"}})
    EXPECT_NE(refusal<S>(step, until).find(std::string("'") + step + "'"), std::string::npos) << step << ", " << until;
}

TYPED_TEST(TimeGridOf, RefusesWhatIsNotPositiveOrFinite) {
  using S = TypeParam;
  for (const char* bad : {"0", "-1", "1-1", "sqrt(2)^2-2", "1/0", "log(0)", "nan", "inf", "sqrt(-1)"}) {
    EXPECT_NE(refusal<S>(bad, "1").find("step"), std::string::npos) << bad;
    EXPECT_NE(refusal<S>("1", bad).find("until"), std::string::npos) << bad;
  }
}

TYPED_TEST(TimeGridOf, AllowsATrillionSteps) {
  using S = TypeParam;
  for (const auto& [step, until] : std::vector<std::pair<const char*, const char*>>{
           {"1", "1e12"}, {"1e-9", "1e3"}, {"1e-12", "1"}, {"pi/10^12", "pi"}, {"1/3", "10^12/3"}})
    EXPECT_EQ(refusal<S>(step, until), "");
}

TYPED_TEST(TimeGridOf, RefusesMoreThanATrillionSteps) {
  using S = TypeParam;
  EXPECT_NE(refusal<S>("1/10^12/2", "1").find("10^12"), std::string::npos);
  EXPECT_NE(refusal<S>("1e-300", "1e300").find("10^12"), std::string::npos);
  EXPECT_NE(refusal<S>("1", "10^12+1").find("10^12"), std::string::npos);
}

TEST(TimeGrid, ARoundedStepThatDividesOnlyInDoubleIsRefusedInMoreDigits) {
  const PrecisionScope digits(50);
  EXPECT_EQ(refusal<double>("0.33333333333333333", "1"), "");
  EXPECT_NE(refusal<Mpfr>("0.33333333333333333", "1"), "");
}

TYPED_TEST(TimeGridOf, ShortensTheLastStepIfAsked) {
  using S = TypeParam;
  const auto shortened = [](const char* step, const char* until) {
    return TimeGrid<S>(Expression::parse(step), Expression::parse(until), {}, Direction::forward, LastStep::shortened);
  };
  const TimeGrid<S> uneven = shortened("1/4", "7/3");
  EXPECT_EQ(uneven.steps(), 10);
  EXPECT_FALSE(uneven.is_even());
  EXPECT_EQ(uneven.time(9), S(9) / 4);
  EXPECT_EQ(uneven.time(10), uneven.until());
  EXPECT_LE(magnitude(S(uneven.last_step() - S(1) / 12)), 8 * epsilon<S>());
  const TimeGrid<S> even = shortened("0.1", "2");
  EXPECT_TRUE(even.is_even());
  EXPECT_EQ(even.steps(), 20);
  EXPECT_EQ(even.last_step(), even.step());
  // An end before the first step is one short step.
  EXPECT_EQ(shortened("1", "1/3").steps(), 1);
}

TEST(TimeGrid, UsesTheScenesConstants) {
  const Constants constants{{"T", Expression::parse("2*pi")}};
  const TimeGrid<double> times(Expression::parse("T/8"), Expression::parse("T"), constants);
  EXPECT_EQ(times.steps(), 8);
  EXPECT_EQ(times.until(), literal<double>("2*pi"));
}

}  // namespace
}  // namespace hbvm::core
