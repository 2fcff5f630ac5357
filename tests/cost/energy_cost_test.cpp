#include "cost/energy_cost.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "cost/cost_methods.hpp"
#include "hbvm/error.hpp"
#include "step/registry.hpp"

namespace hbvm::core {
namespace {

CostStudy energy_study(const char* scene) {
  CostStudy study{load_scene(scene), Expression::parse("10")};
  study.methods = cost_methods({}, 12);
  study.most_seconds = double{1} / 100;
  return study;
}

EnergyCost energy_of(const char* method, const char* precision, long steps) {
  const CostCell cell{parse_method(method), Precision::parse(precision), steps};
  return read_energy_cost(cell, measure_energy(load_scene("kepler"), Expression::parse("10"), cell));
}

TEST(EnergyCost, FollowsTheErrorOfTheEnergy) {
  const EnergyCost gauss = energy_of("hbvm:2,2", "double", 80), finer = energy_of("hbvm:2,2", "double", 160),
                   more_nodes = energy_of("hbvm:8,2", "double", 80);
  EXPECT_EQ(gauss.failure, "");
  EXPECT_GT(gauss.seconds, 0);
  // Of order 4.
  EXPECT_NEAR(gauss.log10_error() - finer.log10_error(), 4 * std::log10(2), 0.2);
  EXPECT_LT(more_nodes.log10_error(), gauss.log10_error() - 3);
  EXPECT_LT(more_nodes.log10_round_off, -13);
  ASSERT_GT(gauss.growth.size(), 10u);
  EXPECT_NEAR(gauss.growth.back()[0], 1, 1e-9);
  for (std::size_t i = 1; i < gauss.growth.size(); ++i) {
    EXPECT_GE(gauss.growth[i][0], gauss.growth[i - 1][0]);
    EXPECT_GE(gauss.growth[i][1], gauss.growth[i - 1][1]) << "the greatest so far";
  }
  EXPECT_LT(energy_of("hbvm:16,2", "mpfr:40", 80).log10_error(), -18);
}

TEST(EnergyCost, LooksAtOneMemberOfEachFamilyAtLikeCost) {
  const CostStudy study = energy_study("kepler");
  const MotionNature nature{1, 0};
  std::set<std::string> methods;
  for (const CostCell& cell : energy_cells(study, nature)) methods.insert(cell.method->text());
  for (const char* const name :
       {"hbvm:2,2", "hbvm:auto,2", "rattle", "compose:rattle,4", "lobatto:3", "restored_hbvm:2,2"})
    EXPECT_TRUE(methods.contains(name)) << name;
  EXPECT_FALSE(methods.contains("taylor"));
  EXPECT_FALSE(methods.contains("hbvm:3,3"));
  // As long as the time allows, from ten times to a thousand.
  CostStudy patient = study, hasty = study;
  patient.most_seconds = 10;
  hasty.most_seconds = 1 / double{1'000'000};
  EXPECT_EQ(energy_until(patient, nature).text(), "10000");
  EXPECT_EQ(energy_until(hasty, nature).text(), "100");
  EXPECT_EQ(times_of(energy_until(hasty, nature), hasty), 10);
}

TEST(EnergyCost, ComparesAllNodesThatAreToldApart) {
  std::vector<std::string> names;
  for (const CostCell& cell : conserving_cells(energy_study("kepler"), MotionNature{1, 0}))
    if (cell.precision.name() == "double") names.push_back(cell.method->text());
  EXPECT_EQ(
      std::vector<std::string>(names.begin(), names.begin() + 7),
      (std::vector<std::string>{"hbvm:1,1", "hbvm:2,1", "hbvm:3,1", "hbvm:4,1", "hbvm:6,1", "hbvm:2,2", "hbvm:3,2"}));
  CostStudy study = energy_study("kepler");
  study.methods = cost_methods({"rattle"}, 12);
  EXPECT_TRUE(conserving_cells(study, MotionNature{1, 0}).empty());
}

TEST(EnergyCost, TakesTheRunsThatCostAsMuch) {
  std::vector<EnergyCost> runs;
  for (const auto& [method, seconds] : {std::pair{"rattle", 1.0},
                                        {"rattle", 4.0},
                                        {"rattle", 9.0},
                                        {"hbvm:2,2", 2.0},
                                        {"hbvm:2,2", 5.0},
                                        {"hbvm:2,2", 20.0}}) {
    runs.push_back({CostCell{parse_method(method), Precision::parse("double"), 1}});
    runs.back().seconds = seconds;
  }
  runs[1].failure = "why";
  const auto equal = at_equal_cost(runs);
  ASSERT_EQ(equal.size(), 2u);
  EXPECT_EQ(equal[0]->seconds, 9) << "next to 5 as a ratio, of those that came to their end";
  EXPECT_EQ(equal[1]->seconds, 5);
}

TEST(EnergyCost, IsReadFromItsOwnResultsAlone) {
  const CostCell cell{parse_method("rattle"), Precision::parse("double"), 1};
  EXPECT_EQ(read_energy_cost(cell, R"({"failure": "why"})").failure, "why");
  EXPECT_THROW(read_energy_cost(cell, "{}"), InputError);
}

}  // namespace
}  // namespace hbvm::core
