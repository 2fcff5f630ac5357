#include "study/step_halving.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "hbvm/error.hpp"
#include "run/scene_run.hpp"
#include "step/hbvm_method.hpp"

namespace hbvm::core {
namespace {

HalvingRow row(long steps, double ulps) {
  HalvingRow r;
  r.steps = steps;
  r.ulps_lambda = r.ulps_hid = r.ulps_g = r.ulps_H = ulps;
  return r;
}

/// The most units that pass for round-off.
double allowed(const std::string& column, long steps) {
  double low = 0, high = 1e12;
  EXPECT_TRUE(row(steps, low).is_round_off(column));
  EXPECT_FALSE(row(steps, high).is_round_off(column));
  for (int i = 0; i < 100; ++i) {
    const double middle = (low + high) / 2;
    (row(steps, middle).is_round_off(column) ? low : high) = middle;
  }
  return low;
}

TEST(RoundOffOfAHalving, WalksLikeTheRootOfTheSteps) {
  for (const char* column : {"e_g", "e_H", "e_hid"}) {
    EXPECT_NEAR(allowed(column, 9'999) / allowed(column, 99), 10, 1e-6) << column;
    EXPECT_GE(allowed(column, 0), 4) << column;
    EXPECT_LE(allowed(column, 0), 16) << column;
  }
  EXPECT_LT(allowed("e_g", 100), allowed("e_hid", 100)) << "the multipliers' roundings";
}

TEST(RoundOffOfAHalving, OfAMultiplierIsThatOfAMomentumOverAStep) {
  EXPECT_NEAR(allowed("e_lambda", 9'999) / allowed("e_lambda", 99), 100, 1e-6);
  EXPECT_LE(allowed("e_lambda", 0), 32);
}

TEST(RoundOffOfAHalving, LooksAtItsOwnColumn) {
  for (const auto& [column, ulps] :
       std::vector<std::pair<const char*, double HalvingRow::*>>{{"e_lambda", &HalvingRow::ulps_lambda},
                                                                 {"e_hid", &HalvingRow::ulps_hid},
                                                                 {"e_g", &HalvingRow::ulps_g},
                                                                 {"e_H", &HalvingRow::ulps_H}}) {
    HalvingRow r = row(10, 0);
    r.*ulps = 1e6;
    for (const char* other : {"e_lambda", "e_hid", "e_g", "e_H"})
      EXPECT_EQ(r.is_round_off(other), other != std::string(column)) << column << " " << other;
  }
  EXPECT_THROW((void)row(10, 0).is_round_off("e_y"), InputError);
}

/// By way of their texts.
std::vector<HalvingRow> rows_of(const HalvingRequest& request, const std::string& precision = "double") {
  const Precision digits = Precision::parse(precision);
  std::vector<HalvingRun> runs;
  for (int i = request.first; i <= request.last + 1; ++i)
    runs.push_back(read_halving_run(to_result(halving_run(request, i, digits))));
  return halving_rows(request, runs, digits);
}

/// Units are of the size of what is measured at the end. On a circle of radius 8, turned by 1/2 with p = 1, the
/// greatest coordinate is 8 cos(1/2), and that of p cos(1/2).
TEST(StepHalving, MeasuresInUnitsOfTheSizes) {
  const Scene scene = read_scene(
      "dimension = 2\npoint = [{ name = \"O\", position = [0, 0] }]\n"
      "body = [{ name = \"a\", mass = 1, position = [8, 0], velocity = [0, 1] }]\n"
      "constraint = [{ kind = \"rod\", between = [\"O\", \"a\"], length = 8 }]\n",
      "circle");
  const HalvingRequest request{
      &scene, hbvm_of({1, 1}), SolverKind::fixed_point, Expression::parse("2^(-i)"), Expression::parse("4"), 1, 3};
  const std::vector<HalvingRow> rows = rows_of(request);
  ASSERT_EQ(rows.size(), 3u);
  for (const HalvingRow& r : rows) {
    EXPECT_EQ(r.steps, 8L << r.i);
    const double ulp = std::ldexp(1, -52), cosine2 = std::cos(0.5) * std::cos(0.5);
    const auto expect_units = [&](double units, const std::string& error, double size) {
      EXPECT_NEAR(units, std::stod(error) / (size * ulp), 0.006 * units) << error;  // three digits are printed
    };
    expect_units(r.ulps_g, r.e_g, 64 * cosine2);
    expect_units(r.ulps_hid, r.e_hid, 8 * cosine2);
    expect_units(r.ulps_H, r.e_H, cosine2);  // more than H = 1/2
    expect_units(r.ulps_lambda, r.e_lambda, 1.0 / 128);
  }
}

/// HBVM(3,1) on the modified pendulum: its energy error falls by 2^6 a row until round-off takes over at the last.
TEST(StepHalving, StarsARateWhereTheErrorIsAFewUnits) {
  const Scene scene = load_scene("modified_pendulum");
  const HalvingRequest request{
      &scene, hbvm_of({3, 1}), SolverKind::fixed_point, Expression::parse("2^(-i)"), Expression::parse("5"), 2, 6};
  int shown = 0, starred = 0;
  for (const HalvingRow& r : rows_of(request)) {
    if (!r.rate_H) continue;
    EXPECT_EQ(*r.rate_H == "***", r.ulps_H <= 16) << r.e_H << ", " << r.ulps_H << " units";
    ++(*r.rate_H == "***" ? starred : shown);
    if (r.ulps_H > 1'000) {
      EXPECT_NEAR(std::stod(*r.rate_H), 6, 0.2);
    }
  }
  EXPECT_GE(shown, 1);
  EXPECT_GE(starred, 1);
}

/// Every number is there to its last digit: a difference of two runs is made of them.
TEST(StepHalving, KeepsTheNumbersOfARunExactly) {
  const Scene scene = load_scene("modified_pendulum");
  const HalvingRequest request{
      &scene, hbvm_of({3, 1}), SolverKind::fixed_point, Expression::parse("2^(-i)"), Expression::parse("1"), 4, 4};
  for (const char* const precision : {"double", "quad", "mpfr:50"}) {
    const HalvingRun run = halving_run(request, 4, Precision::parse(precision));
    EXPECT_EQ(run.steps, 16);
    EXPECT_EQ(run.q.size(), 2u);
    EXPECT_EQ(run.lambda.size(), 1u);
    const hbvm::Run same = core::run({scene, request.method, SolverKind::fixed_point, Expression::parse("1/16"),
                                      request.until, Precision::parse(precision)},
                                     {});
    EXPECT_EQ(run.q, same.q) << precision;
    EXPECT_EQ(run.p, same.p) << precision;
    EXPECT_EQ(run.lambda, same.lambda) << precision;
    EXPECT_EQ(run.e_H, same.e_H) << precision;
    EXPECT_EQ(run.e_g, same.e_g) << precision;
    EXPECT_EQ(run.e_hid, same.e_hid) << precision;
    EXPECT_EQ(to_result(read_halving_run(to_result(run))), to_result(run));
    // A run is compared with itself: nothing is lost between.
    for (const HalvingRow& row :
         halving_rows(request, {run, read_halving_run(to_result(run))}, Precision::parse(precision)))
      EXPECT_EQ(row.e_y + row.e_lambda, "0.00e+000.00e+00") << precision;
  }
  EXPECT_THROW(read_halving_run("{}"), InputError);
}

}  // namespace
}  // namespace hbvm::core
