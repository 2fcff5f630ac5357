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

TEST(Judge, IntervalsThatHoldTheWholeRateHold) {
  for (const Form form : {Form::at_least, Form::exactly}) {
    EXPECT_EQ(judged(form, 4, 4, 0), Verdict::holds);
    EXPECT_EQ(judged(form, 4, 3.9, 0.11), Verdict::holds);
    EXPECT_EQ(judged(form, 4, 4.1, 0.11), Verdict::holds);
  }
}

TEST(Judge, IntervalsBelowFail) {
  for (const Form form : {Form::at_least, Form::exactly}) {
    EXPECT_EQ(judged(form, 4, 3, 0), Verdict::fails);
    EXPECT_EQ(judged(form, 4, 3, 0.99), Verdict::fails);
    EXPECT_EQ(judged(form, 4, 3.9, 0.09), Verdict::fails);
    EXPECT_EQ(judged(form, 4, -1, 2), Verdict::fails);
  }
}

TEST(Judge, IntervalsAboveFailOnlyIfClaimedExactly) {
  EXPECT_EQ(judged(Form::at_least, 4, 5, 0), Verdict::holds);
  EXPECT_EQ(judged(Form::at_least, 4, 40, 10), Verdict::holds);
  EXPECT_EQ(judged(Form::exactly, 4, 5, 0), Verdict::fails);
  EXPECT_EQ(judged(Form::exactly, 4, 4.1, 0.09), Verdict::fails);
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

TEST(Judge, WideIntervalsAreUndecidable) {
  for (const Form form : {Form::at_least, Form::exactly}) {
    EXPECT_EQ(judged(form, 4, 4, 1), Verdict::undecidable);
    EXPECT_EQ(judged(form, 4, 3, 1.1), Verdict::undecidable);
    EXPECT_EQ(judged(form, 4, 4, quarter), Verdict::undecidable);
    EXPECT_EQ(judged(form, 4, 4 - half, 1), Verdict::undecidable);
    EXPECT_EQ(judged(form, 4, 4, std::numeric_limits<double>::infinity()), Verdict::undecidable);
  }
  EXPECT_EQ(judged(Form::at_least, 4, 5, 0.99), Verdict::holds) << "from the bound on it is wide enough";
}

TEST(Judge, WithoutARateNothingIsDecided) {
  for (const Form form : {Form::at_least, Form::exactly}) {
    Claim claim;
    claim.form = form;
    EXPECT_EQ(judge(claim, std::nullopt), Verdict::undecidable);
  }
}

TEST(Judge, WhatIsNotANumberDecidesNothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Form form : {Form::at_least, Form::exactly}) {
    EXPECT_EQ(judged(form, 4, nan, 0), Verdict::undecidable);
    EXPECT_EQ(judged(form, 4, 4, nan), Verdict::undecidable);
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
