#include "analysis/audit/auditor.hpp"

#include <gtest/gtest.h>

namespace hbvm {
namespace {

Finding found(Quantity quantity, const std::string& problem, MethodName method, const char* relative) {
  Claim claim = make_claim("test", quantity, problem, Span::interval, Form::round_off, 0);
  claim.method = method;
  if (relative) claim.perturbation = Perturbation{Perturbation::Part::weight, true, 0, 0, Expression::parse(relative)};
  AuditOptions options;
  options.starts = 1;
  return audit({claim}, options).front();
}

/// What is conserved must be to 1024 units of round-off. A weight wrong by 1e-95 shows in 100 digits alone, as an
/// energy error of some ten thousand.
TEST(Auditor, ConservationIsToAThousandUnits) {
  const Finding right = found(Quantity::H, "quartic_oscillator", {4, 2}, nullptr);
  EXPECT_EQ(right.verdict, Verdict::holds);
  EXPECT_LE(right.measured, 100);
  const Finding wrong = found(Quantity::H, "quartic_oscillator", {4, 2}, "1e-95");
  EXPECT_EQ(wrong.verdict, Verdict::fails);
  EXPECT_GT(wrong.measured, 1'100) << "no test of the bound";
  EXPECT_LT(wrong.measured, 100'000) << "no test of the bound";
  EXPECT_EQ(wrong.uncertainty, 1024);
  EXPECT_EQ(wrong.precision, "mpfr:100");
}

/// A method's coefficients must meet their conditions to two units a stage, here eight.
TEST(Auditor, CoefficientsAreToTwoUnitsAStage) {
  const Finding right = found(Quantity::B, "tableau", {4, 2}, nullptr);
  EXPECT_EQ(right.verdict, Verdict::holds);
  EXPECT_EQ(right.uncertainty, 8);
  const Finding wrong = found(Quantity::B, "tableau", {4, 2}, "1e-98");
  EXPECT_EQ(wrong.verdict, Verdict::fails);
  EXPECT_GT(wrong.measured, 8);
  EXPECT_LT(wrong.measured, 800) << "no test of the bound";
}

}  // namespace
}  // namespace hbvm
