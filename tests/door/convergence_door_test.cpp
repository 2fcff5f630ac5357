#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "hbvm/error.hpp"
#include "hbvm/study.hpp"
#include "words.hpp"

namespace hbvm {
namespace {

ConvergenceRequest slow_pendulum() {
  return {.scene = load_scene("double_pendulum"),
          .methods = {"rattle", "gauss:2"},
          .steps = "1/16:1/256",
          .precisions = {"mpfr:30"}};
}

TEST(DoorConvergence, TellsOrdersAndPoints) {
  const ConvergenceStudy result = convergence(slow_pendulum());
  EXPECT_EQ(result.until, "1");
  ASSERT_EQ(result.methods.size(), 2u);
  EXPECT_NEAR(result.methods[1].q->value, 4, 0.2);
  const nlohmann::json json = nlohmann::json::parse(to_json(result));
  const nlohmann::json& rattle = json["methods"][0];
  EXPECT_EQ(rattle["method"], "rattle");
  EXPECT_NEAR(rattle["orders"]["lambda"]["rate"].get<double>(), 2, 0.2);
  EXPECT_TRUE(rattle["orders"]["p"].contains("uncertainty"));
  EXPECT_EQ(rattle["points"].size(), 5u);
  EXPECT_EQ(rattle["points"][0]["step"], "0.0625");
  EXPECT_TRUE(rattle["points"][0]["error"].contains("lambda"));
  core::expect_words(to_text(result), {"order of lambda", "rattle", "gauss:2 (hbvm:2,2)", "+-", "output state"});
  EXPECT_EQ(json["methods"][1]["method"], "gauss:2");
  EXPECT_EQ(json["methods"][1]["resolved"], "hbvm:2,2");
  EXPECT_NE(result.command.find("--methods rattle gauss:2 "), std::string::npos);
  EXPECT_FALSE(result.figure);
}

/// A row a step with the errors of q, p and lambda, and the orders in the last.
TEST(DoorConvergence, PrintsErrorsAgainstTheStep) {
  ConvergenceRequest request = slow_pendulum();
  request.methods = {"rattle"};
  const ConvergenceStudy result = convergence(request);
  const std::string text = to_text(result);
  const MethodOrders& one = result.methods[0];
  std::size_t at = text.find("rattle, mpfr:30\n");
  const char* const steps[] = {"1/16", "1/32", "1/64", "1/128", "1/256"};
  for (std::size_t i = 0; i < one.points.size(); ++i)
    for (const std::string& cell :
         {"  " + std::string(steps[i]) + " ", one.points[i].q, one.points[i].p, one.points[i].lambda}) {
      at = text.find(cell, at);
      ASSERT_NE(at, std::string::npos) << cell << " in\n" << text;
    }
  EXPECT_NE(text.find("  order ", at), std::string::npos);
  EXPECT_EQ(text.find("orders of all"), std::string::npos) << "of one method they stand there already";
  request.steps = "1/(3*pi):1/(48*pi)";
  request.until = "4/pi";
  request.methods = {"rattle", "gauss:2"};
  core::expect_words(to_text(convergence(request)), {"  0.106103 ", "orders of all"});
}

TEST(DoorConvergence, LeavesOutMultipliersThatThereAreNot) {
  ConvergenceRequest request = slow_pendulum();
  request.scene = load_scene("kepler");
  request.picture = true;
  const ConvergenceStudy result = convergence(request);
  EXPECT_EQ(result.figure->panels.size(), 2u);
  EXPECT_FALSE(nlohmann::json::parse(to_json(result))["methods"][0]["orders"].contains("lambda"));
  EXPECT_EQ(to_text(result).find("lambda"), std::string::npos);
}

TEST(DoorConvergence, RefusesWhatItCannotMeasure) {
  const auto refused = [](auto change) {
    ConvergenceRequest request = slow_pendulum();
    change(request);
    EXPECT_THROW(convergence(request), InputError);
  };
  refused([](auto& r) { r.methods.clear(); });
  refused([](auto& r) { r.precisions.clear(); });
  refused([](auto& r) { r.steps = "1/16"; });
  refused([](auto& r) { r.until = "1/3"; });
  refused([](auto& r) { r.methods = std::vector<std::string>(10, "rk4"); });
}

}  // namespace
}  // namespace hbvm
