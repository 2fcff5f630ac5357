#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "hbvm/error.hpp"
#include "hbvm/run.hpp"

namespace hbvm {
namespace {

TEST(DoorRunJson, SaysWhatTheRunIs) {
  RunRequest request{
      .scene = load_scene("kepler"), .method = "hbvm:auto,2", .step = "1/64", .until = 1, .precision = "double"};
  request.account = request.shadow = request.error = true;
  request.on_failure = "halve";
  const hbvm::Run made = run(request);
  const nlohmann::json json = nlohmann::json::parse(to_json(made));
  EXPECT_EQ(json.at("scene"), "kepler");
  EXPECT_EQ(json.at("method"), made.method);
  EXPECT_EQ(json.at("steps"), 64);
  EXPECT_EQ(json.at("q"), made.q);
  EXPECT_EQ(json.at("output").at("p"), made.output_p);
  EXPECT_EQ(json.at("chosen").at("k"), made.nodes->k);
  EXPECT_EQ(json.at("halved").at("steps"), 0);
  EXPECT_EQ(json.at("shadow").at("precision"), "mpfr:32");
  EXPECT_EQ(json.at("error").at("digits").size(), 4u);
  EXPECT_GT(json.at("account").size(), 1u);
  EXPECT_EQ(json.at("account").at(0).at("effect"), true);
  EXPECT_FALSE(json.contains("trajectory"));
  EXPECT_EQ(read_scene(json.at("scene_text")).toml(), made.scene_toml);
}

/// What is proved, with and without constraints.
TEST(DoorRunJson, HoldsWhatIsProved) {
  RunRequest request{.scene = load_scene("double_pendulum"), .method = "hbvm:3,2", .step = "1/4", .until = 1};
  EXPECT_FALSE(nlohmann::json::parse(to_json(run(request))).contains("proved"));
  request.prove = true;
  const hbvm::Run made = run(request);
  const nlohmann::json proved = nlohmann::json::parse(to_json(made)).at("proved");
  EXPECT_EQ(proved.at("steps"), 4);
  EXPECT_EQ(proved.at("digits"), 15);
  EXPECT_EQ(proved.at("q"), made.proved->q);
  EXPECT_EQ(proved.at("lambda_names"), made.lambda_names);
  EXPECT_EQ(proved.at("radius").at("lambda"), made.proved->lambda_radius);
  EXPECT_EQ(proved.at("e_H"), made.proved->e_H);
  EXPECT_TRUE(proved.at("e_H_least").is_null());
  EXPECT_EQ(proved.at("off").at("p"), made.proved->off_p);
  request.scene = load_scene("kepler");
  const nlohmann::json free = nlohmann::json::parse(to_json(run(request))).at("proved");
  EXPECT_TRUE(free.at("e_g").is_null());
  EXPECT_TRUE(free.at("radius").at("lambda").is_null());
  EXPECT_TRUE(free.at("e_H_least").is_string());
}

/// Every other point of four steps, as the end is told, by names.
TEST(DoorRunJson, HoldsTheStatesIfAsked) {
  RunRequest request{.scene = load_scene("double_pendulum"), .method = "hbvm:3,2", .step = "1/4", .until = 1};
  request.every = 2;
  const hbvm::Run made = run(request);
  EXPECT_FALSE(nlohmann::json::parse(to_json(made)).contains("states"));
  const nlohmann::json json = nlohmann::json::parse(to_json(made, true));
  EXPECT_EQ(json.at("names").at("q"), (std::vector<std::string>{"a.x", "a.y", "b.x", "b.y"}));
  EXPECT_EQ(json.at("names").at("p").at(3), "b.py");
  EXPECT_EQ(json.at("names").at("lambda"), (std::vector<std::string>{"rod 'pivot'-'a'", "rod 'a'-'b'"}));
  const nlohmann::json& states = json.at("states");
  ASSERT_EQ(states.size(), 3u);
  EXPECT_EQ(states[0].at("t"), "0");
  EXPECT_EQ(states[0].at("q"), (std::vector<std::string>{"0.8", "-0.6", "1.3", "-1.8"}));
  EXPECT_EQ(states[1].at("t"), "0.5");
  EXPECT_EQ(states[2].at("t"), json.at("t"));
  for (const char* const what : {"q", "p", "lambda", "output"}) {
    nlohmann::json end = json.at(what);
    if (what == std::string("output")) end.erase("delta_H");
    EXPECT_EQ(states[2].at(what), end) << what;
  }
}

/// What the scene observes: at the end, in each state, in a column, and in a panel of its own.
TEST(DoorRunJson, HoldsWhatIsObserved) {
  RunRequest request{.scene = load_scene("double_pendulum"), .method = "hbvm:3,2", .step = "1/4", .until = 1};
  request.scene.observe("T", "tension(pivot, a)").observe("a.x", "2*a.x");
  EXPECT_THROW(run(request), InputError) << "there is a column a.x";
  request.scene = load_scene("double_pendulum");
  request.scene.observe("T", "tension(pivot, a)").observe("twice", "2*a.x");
  request.picture = true;
  const hbvm::Run made = run(request);
  ASSERT_EQ(made.observations.size(), 2u);
  EXPECT_EQ(made.observations[0].name, "T");
  EXPECT_EQ(made.observations[0].formula, "tension(pivot, a)");
  EXPECT_EQ(made.observations[1].value, made.trajectory.text("twice").back());
  EXPECT_EQ(std::stod(made.observations[1].value), 2 * std::stod(made.q[0]));
  EXPECT_NEAR(std::stod(made.observations[0].value), 2 * std::stod(made.output_lambda[0]), 1e-13);
  EXPECT_EQ(made.trajectory.values("T").size(), 5u);
  const nlohmann::json json = nlohmann::json::parse(to_json(made, true));
  EXPECT_EQ(json.at("observed").at("twice"), made.observations[1].value);
  EXPECT_EQ(json.at("observed_range").at("twice").at("least"), made.observations[1].least);
  EXPECT_EQ(json.at("observed_range").at("twice").at("greatest_t"), made.observations[1].greatest_t);
  EXPECT_EQ(json.at("states")[4].at("observed"), json.at("observed"));
  EXPECT_NE(json.at("states")[0].at("observed"), json.at("observed"));
  EXPECT_EQ(read_scene(json.at("scene_text")).toml(), made.scene_toml);
  EXPECT_NE(made.command.find(" --observe 'T=tension(pivot, a)' --observe 'twice=2*a.x'"), std::string::npos);
  ASSERT_TRUE(made.figure);
  const auto panel = [&](const std::string& title) {
    return std::any_of(made.figure->panels.begin(), made.figure->panels.end(),
                       [&](const Panel& p) { return p.title == title && p.curves.size() == 1; });
  };
  EXPECT_TRUE(panel("T") && panel("twice"));
  EXPECT_NE(made.page.find("\"twice\""), std::string::npos);
}

}  // namespace
}  // namespace hbvm
