#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cost/planner.hpp"
#include "step/registry.hpp"

namespace hbvm::core {
namespace {

Plan given_plan() {
  Plan plan{{parse_method("hbvm:6,6"), Precision::parse("double"), 52}, {}, {1.25, 0}, {}, 3};
  plan.pick.step = "5/26";
  plan.pick.predicted_seconds = 0.25;
  plan.pick.predicted_error = -12.5;
  plan.pick.seconds = 0.5;
  plan.pick.error = -12.25;
  PlannedSetting other{parse_method("rattle"), Precision::parse("mpfr:400"), 7};
  other.predicted_error = -350;
  plan.runners_up.push_back(other);
  return plan;
}

const PlanRequest twelve_digits{load_scene("kepler"), Expression::parse("10"), 12};

TEST(PlanReport, HasTheKeysThatProgramsRead) {
  const auto json = nlohmann::json::parse(to_json(twelve_digits, given_plan(), "the command"));
  EXPECT_EQ(json.at("digits"), 12);
  EXPECT_EQ(json.at("pick"), (nlohmann::json{{"method", "hbvm:6,6"}, {"step", "5/26"}, {"precision", "double"}}));
  EXPECT_EQ(json.at("predicted").at("seconds"), 0.25);
  EXPECT_EQ(json.at("measured").at("seconds"), 0.5);
  EXPECT_NEAR(json.at("measured").at("error").get<double>(), 5.6234e-13, 1e-16);
  EXPECT_TRUE(json.at("runners_up").at(0).at("measured").is_null());
  // Double has no such number.
  EXPECT_EQ(json.at("runners_up").at(0).at("predicted").at("error"), "1e-350.00");
}

TEST(PlanReport, EndsWithTheCommandToCopy) {
  const std::string text = to_text(twelve_digits, given_plan());
  EXPECT_TRUE(text.ends_with("\n  hbvm run kepler --method hbvm:6,6 --step 5/26 --until 10 --precision double\n"))
      << text;
  EXPECT_NE(text.find("5.6e-13"), std::string::npos) << text;
}

}  // namespace
}  // namespace hbvm::core
