#include "audit/auditor.hpp"

#include <gtest/gtest.h>

#include "folder.hpp"
#include "step/hbvm_method.hpp"

namespace hbvm::core {
namespace {

Claim claim(Quantity quantity, const std::string& problem, HbvmName method, Form form, double predicted = 0) {
  Claim claim = make_claim("test", quantity, problem, Span::interval, form, predicted);
  claim.method = hbvm_of(method);
  return claim;
}

Claim conserved(Quantity quantity, const std::string& problem, HbvmName method) {
  return claim(quantity, problem, method, Form::round_off);
}

AuditOptions one_start() {
  AuditOptions options;
  options.starts = 1;
  return options;
}

Finding found(const Claim& claim, const AuditOptions& options = one_start()) { return audit({claim}, options).front(); }

Claim with_wrong_weight(Claim claim, const char* relative) {
  claim.method = hbvm_of(as_hbvm(*claim.method)->name(),
                         Perturbation{Perturbation::Part::weight, true, 0, 0, Expression::parse(relative)});
  return claim;
}

/// A constant beyond the range of double is no reason to refuse what is decided with more.
TEST(Auditor, BeginsWhereTheNumbersOfTheSceneAreInRange) {
  const Folder folder;
  const std::string file =
      folder.write("scene.toml",
                   "dimension = 2\n[constants]\ne = \"1e-420\"\n[[body]]\nname = \"a\"\nmass = 1\nposition = [1, "
                   "0]\nvelocity = [0, \"1/2\"]\n[[effect]]\nkind = \"formula\"\nU = \"-x^2/2 - y^2 - e*x\"\n");
  const Finding energy = found(conserved(Quantity::H, file, {2, 2}));
  EXPECT_EQ(energy.verdict, Verdict::holds) << energy.reason;
  EXPECT_EQ(energy.evidence.front().precision, "quad");
}

/// A weight wrong by 1e-93 shows with 100 digits alone, though nobody looks at the coefficients. It is an energy error
/// of some ten thousand times what is allowed.
TEST(Auditor, ConservationIsToWhatRoundOffExplains) {
  const Claim energy = conserved(Quantity::H, "quartic_oscillator", {4, 2});
  const Finding right = found(energy);
  EXPECT_EQ(right.verdict, Verdict::holds);
  EXPECT_EQ(right.uncertainty, 4 * (4 + 2));
  EXPECT_LE(right.measured, 6) << "one unit for each node and coefficient";
  EXPECT_EQ(right.reason, "the nodes integrate U of degree 4 exactly");
  AuditOptions options = one_start();
  options.coefficient_digits = 0;
  const Finding wrong = found(with_wrong_weight(energy, "1e-93"), options);
  EXPECT_EQ(wrong.verdict, Verdict::fails);
  EXPECT_GT(wrong.measured, 24);
  EXPECT_LT(wrong.measured, 1e8) << "no test of the bound";
  EXPECT_EQ(wrong.precision, "mpfr:100");
  EXPECT_EQ(wrong.coefficients_to, 0);
}

/// A method's coefficients must meet their conditions to two units a stage, here eight.
TEST(Auditor, CoefficientsAreToTwoUnitsAStage) {
  const Claim condition = conserved(Quantity::B, "tableau", {4, 2});
  const Finding right = found(condition);
  EXPECT_EQ(right.verdict, Verdict::holds);
  EXPECT_EQ(right.uncertainty, 8);
  EXPECT_EQ(right.coefficients_to, 1000);
  EXPECT_FALSE(right.interval);
  const Finding wrong = found(with_wrong_weight(condition, "1e-98"));
  EXPECT_EQ(wrong.verdict, Verdict::fails);
  EXPECT_GT(wrong.measured, 8);
  EXPECT_LT(wrong.measured, 800) << "no test of the bound";
}

/// Far below what any error shows.
TEST(Auditor, CoefficientsAreSeenToAThousandDigits) {
  for (const auto& [relative, digits] :
       {std::pair("1e-30", 30), {"1e-60", 60}, {"1e-95", 95}, {"1e-300", 300}, {"1e-900", 900}})
    for (const Claim& right :
         {claim(Quantity::q, "kepler", {3, 2}, Form::at_least, 4), conserved(Quantity::H, "quartic_oscillator", {4, 2}),
          conserved(Quantity::B, "tableau", {3, 2})}) {
      const Finding f = found(with_wrong_weight(right, relative));
      EXPECT_EQ(f.verdict, Verdict::fails) << relative << " " << name_of(right.quantity);
      // The weight is less than 1/2, so that its flaw is a digit smaller.
      EXPECT_NEAR(f.coefficients_to, digits, 1) << relative << " " << name_of(right.quantity);
    }
}

/// Neither k = 30 nor k = 60 conserves a rational U, and double, quad, 50 and 100 digits show nothing of it.
TEST(Auditor, ExactnessIsTriedWhereItCouldFail) {
  for (const Claim& smaller_than_any_look :
       {conserved(Quantity::H, "modified_pendulum", {30, 1}), conserved(Quantity::H, "kepler", {60, 1}),
        conserved(Quantity::angular_momentum, "kepler", {33, 30})}) {
    const Finding f = found(smaller_than_any_look);
    EXPECT_EQ(f.verdict, Verdict::fails) << f.claim.method_text() << " on " << f.claim.problem;
    EXPECT_EQ(f.reason, "it is more than round-off");
  }
}

TEST(Auditor, DegenerateMotionsSayNothing) {
  const Claim conical = claim(Quantity::p, "conical_pendulum", {2, 2}, Form::at_least, 4);
  const Finding f = found(conical);
  EXPECT_EQ(f.verdict, Verdict::degenerate);
  EXPECT_NE(f.reason.find("relative equilibrium"), std::string::npos) << f.reason;
  Claim aware = conical;
  aware.of_degenerate_motion = true;
  EXPECT_EQ(found(aware).verdict, Verdict::holds);
  // What is false there is false.
  EXPECT_EQ(found(claim(Quantity::p, "conical_pendulum", {2, 2}, Form::at_least, 5)).verdict, Verdict::fails);
}

TEST(Auditor, WhatCannotBeRunLosesNoOtherVerdict) {
  const std::vector<Finding> findings = audit({claim(Quantity::q, "no such scene", {1, 1}, Form::at_least, 2),
                                               claim(Quantity::q, "kepler", {1, 1}, Form::at_least, 2)},
                                              one_start());
  EXPECT_EQ(findings[0].verdict, Verdict::not_run);
  EXPECT_NE(findings[0].reason.find("no such scene"), std::string::npos) << findings[0].reason;
  EXPECT_EQ(findings[1].verdict, Verdict::holds);
}

TEST(Auditor, TimeIsLimited) {
  AuditOptions options = one_start();
  options.limit = double{1} / 1024;
  const Finding f = found(claim(Quantity::q, "kepler", {8, 8}, Form::at_least, 16), options);
  EXPECT_EQ(f.verdict, Verdict::undecidable);
  EXPECT_NE(f.reason.find("--limit"), std::string::npos) << f.reason;
  EXPECT_GE(f.seconds, options.limit);
}

/// Two eighths of the time scale, 2, after three of them; and all of it up to a time.
TEST(Auditor, TellsTheIntervalItLookedAt) {
  const Claim claim_of_interval = claim(Quantity::q, "modified_pendulum", {1, 1}, Form::at_least, 2);
  const Finding f = found(claim_of_interval);
  ASSERT_TRUE(f.interval);
  EXPECT_EQ(f.interval->from, double{3} / 4);
  EXPECT_EQ(f.interval->to, double{3} / 4 + 1);
  AuditOptions options;
  options.until = Expression::parse("5");
  const Finding wide = found(claim_of_interval, options);
  ASSERT_TRUE(wide.interval);
  EXPECT_EQ(wide.interval->from, 0);
  EXPECT_GE(wide.interval->to, 5);
  EXPECT_LT(wide.interval->to, 7);
  EXPECT_EQ(wide.verdict, Verdict::holds);
}

}  // namespace
}  // namespace hbvm::core
