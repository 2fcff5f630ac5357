#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

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

}  // namespace
}  // namespace hbvm
