#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "hbvm/error.hpp"
#include "hbvm/study.hpp"
#include "words.hpp"

namespace hbvm {
namespace {

MethodsRequest kepler() {
  return {.scene = load_scene("kepler"), .methods = {"rk4", "verlet", "hbvm:auto,3"}, .step = "1/16", .until = 10};
}

TEST(DoorMethods, TellErrorsAndDigits) {
  MethodsRequest request = kepler();
  request.reference = true;
  const MethodComparison comparison = compare_methods(request);
  ASSERT_EQ(comparison.runs.size(), 3u);
  EXPECT_EQ(comparison.runs[1].method, "verlet");
  EXPECT_LT(std::stod(comparison.runs[2].e_H), 1e-13);
  EXPECT_GT(*comparison.runs[2].digits, *comparison.runs[0].digits);
  EXPECT_FALSE(comparison.figure);
  const nlohmann::json json = nlohmann::json::parse(to_json(comparison));
  EXPECT_EQ(json["runs"].size(), 3u);
  for (const char* const key : {"method", "e_H", "e_g", "e_hid", "digits", "cpu_seconds"})
    EXPECT_TRUE(json["runs"][0].contains(key)) << key;
  EXPECT_EQ(json["command"],
            "hbvm compare kepler --methods rk4 verlet hbvm:auto,3 --step '1/16' --until '10' --precision double "
            "--reference");
  core::expect_words(to_text(comparison), {"kepler", "method", "e_H", "digits", "rk4", "seconds"});
  EXPECT_EQ(to_text(comparison).find("e_hid"), std::string::npos);
}

TEST(DoorMethods, MakePicturesIfAsked) {
  MethodsRequest request = kepler();
  request.picture = true;
  request.step.reset();
  const MethodComparison comparison = compare_methods(request);
  EXPECT_EQ(comparison.step, "1/32");
  EXPECT_EQ(comparison.figure->panels.size(), 3u);
  EXPECT_TRUE(comparison.page.starts_with("<!DOCTYPE html>"));
}

/// As run() tells them, method by method.
TEST(DoorMethods, TellWarningsOfEachRun) {
  const MethodComparison comparison = compare_methods(
      {.scene = load_scene("simple_pendulum"), .methods = {"rk4", "hbvm:auto,3"}, .step = "1/8", .until = 100});
  const hbvm::Run alone = run({.scene = load_scene("simple_pendulum"), .method = "rk4", .step = "1/8", .until = 100});
  const nlohmann::json runs = nlohmann::json::parse(to_json(comparison))["runs"];
  EXPECT_EQ(runs[0]["warnings"], nlohmann::json::parse(to_json(alone))["health"]["warnings"]);
  ASSERT_EQ(runs[0]["warnings"].size(), 2u);
  EXPECT_EQ(runs[1]["warnings"].size(), 0u);
  const std::string text = to_text(comparison);
  core::expect_words(text, {"rk4: WARNING energy_changed: H is off", "rk4: WARNING constraint_drift: "});
  EXPECT_EQ(text.find("hbvm:auto,3: WARNING"), std::string::npos);
}

/// The name that was asked for, and beside it what it is.
TEST(DoorMethods, KeepTheNamesTheyWereGiven) {
  const MethodComparison comparison = compare_methods(kepler());
  EXPECT_EQ(comparison.runs[0].resolved, "rk4");
  EXPECT_EQ(comparison.runs[1].resolved, "rattle");
  EXPECT_NE(comparison.runs[2].resolved, "hbvm:auto,3");
  const std::string text = to_text(comparison);
  core::expect_words(text, {"verlet: this is rattle\n", "hbvm:auto,3: this is hbvm:"});
  EXPECT_EQ(text.find("rk4: this is"), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(to_json(comparison))["runs"][1]["resolved"], "rattle");
}

TEST(DoorMethods, TellOfOneThatFails) {
  const MethodComparison comparison = compare_methods(
      {.scene = load_scene("double_pendulum"), .methods = {"rattle", "rk4"}, .step = "2", .until = "40"});
  EXPECT_NE(comparison.runs[0].failure, "");
  core::expect_words(to_text(comparison), {"rattle: "});
  EXPECT_TRUE(nlohmann::json::parse(to_json(comparison))["runs"][0].contains("failure"));
}

TEST(DoorMethods, RefuseWhatCannotBeCompared) {
  MethodsRequest request = kepler();
  request.methods = {};
  EXPECT_THROW(compare_methods(request), InputError);
  request.methods = std::vector<std::string>(10, "rk4");
  EXPECT_THROW(compare_methods(request), InputError);
  request.methods = {"rk4", "none"};
  EXPECT_THROW(compare_methods(request), InputError);
}

}  // namespace
}  // namespace hbvm
