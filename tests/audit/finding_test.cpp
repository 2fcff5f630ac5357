#include "audit/finding.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace hbvm::core {
namespace {

constexpr double half = double{1} / 2, quarter = half / 2;

Verdict judged(Form form, double predicted, double measured, double uncertainty) {
  Claim claim;
  claim.form = form;
  claim.predicted = predicted;
  return judge(claim, Rate{measured, uncertainty, 4});
}

/// Alike for `at_least` and `exactly`, but where the interval lies above the rate.
TEST(Judge, ByWhereTheIntervalLies) {
  const auto at_least_and_exactly = [](double measured, double uncertainty) {
    return std::pair(judged(Form::at_least, 4, measured, uncertainty), judged(Form::exactly, 4, measured, uncertainty));
  };
  const double infinite = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  const Verdict holds = Verdict::holds, fails = Verdict::fails, open = Verdict::undecidable;
  struct Case {
    const char* where;
    double measured, uncertainty;
    Verdict at_least, exactly;
  };
  for (const Case& c : {Case{"on it", 4, 0, holds, holds}, Case{"around it", 3.9, 0.11, holds, holds},
                        Case{"around it", 4.1, 0.11, holds, holds}, Case{"below it", 3, 0, fails, fails},
                        Case{"below it", 3, 0.99, fails, fails}, Case{"below it", 3.9, 0.09, fails, fails},
                        Case{"below it", -1, 2, fails, fails}, Case{"above it", 5, 0, holds, fails},
                        Case{"above it", 4.1, 0.09, holds, fails}, Case{"above it", 40, 10, holds, fails},
                        Case{"from it on, wide enough", 5, 0.99, holds, fails}, Case{"too wide", 4, 1, open, open},
                        Case{"too wide", 3, 1.1, open, open}, Case{"too wide", 4, quarter, open, open},
                        Case{"too wide", 4 - half, 1, open, open}, Case{"too wide", 4, infinite, open, open},
                        Case{"no number", nan, 0, open, open}, Case{"no number", 4, nan, open, open}})
    EXPECT_EQ(at_least_and_exactly(c.measured, c.uncertainty), std::pair(c.at_least, c.exactly))
        << c.where << ": " << c.measured << " +- " << c.uncertainty;
}

/// No rate that is not whole is that of an error, and no half is allowed it.
TEST(Judge, RatesThatAreNotWholeNeverHoldBeyondTheInterval) {
  for (const double off : {0.05, 0.1, 0.25, 0.4, 0.49, 0.4999}) {
    EXPECT_EQ(judged(Form::at_least, 2 + off, 2, 0.005), Verdict::fails) << off;
    EXPECT_EQ(judged(Form::at_least, 2 - off, 2, 0.005), Verdict::holds) << off;
    EXPECT_EQ(judged(Form::exactly, 2 + off, 2, 0.005), Verdict::fails) << off;
    EXPECT_EQ(judged(Form::exactly, 2 - off, 2, 0.005), Verdict::fails) << off;
  }
  for (const Form form : {Form::at_least, Form::exactly}) {
    EXPECT_EQ(judged(form, 2.004, 2, 0.005), Verdict::undecidable);
    EXPECT_EQ(judged(form, 2.004, 2, 0.003), Verdict::fails);
  }
}

TEST(Judge, WithoutARateNothingIsDecided) {
  for (const Form form : {Form::at_least, Form::exactly}) {
    Claim claim;
    claim.form = form;
    EXPECT_EQ(judge(claim, std::nullopt), Verdict::undecidable);
  }
}

TEST(Verdicts, HaveNames) {
  EXPECT_EQ(name_of(Verdict::holds), "holds");
  EXPECT_EQ(name_of(Verdict::fails), "fails");
  EXPECT_EQ(name_of(Verdict::undecidable), "undecidable");
  EXPECT_EQ(name_of(Verdict::degenerate), "degenerate");
  EXPECT_EQ(name_of(Verdict::not_run), "not run");
}

}  // namespace
}  // namespace hbvm::core
