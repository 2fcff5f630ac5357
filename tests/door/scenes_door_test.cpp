#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "hbvm/scene.hpp"

namespace hbvm {
namespace {

TEST(DoorScenes, AreReadAndUsed) {
  const std::vector<SceneEntry> all = scenes();
  EXPECT_GT(all.size(), 30u);
  for (const SceneEntry& scene : {all.front(), all.back()}) load_scene(scene.name).check();
}

TEST(DoorScenes, SayWhatTheyHold) {
  const std::vector<SceneEntry> all = scenes();
  const auto top = std::find_if(all.begin(), all.end(), [](const auto& scene) { return scene.name == "heavy_top"; });
  ASSERT_NE(top, all.end());
  EXPECT_EQ(top->rigid_bodies, 1);
  EXPECT_EQ(top->dimension, 3);
  const auto chain = std::find_if(all.begin(), all.end(), [](const auto& scene) { return scene.name == "chain"; });
  ASSERT_NE(chain, all.end());
  EXPECT_EQ(chain->constraints, std::vector<std::string>{"rod"});
  EXPECT_EQ(chain->effects, std::vector<std::string>{"uniform_gravity"});
}

TEST(DoorScenes, AreTextAndJson) {
  const std::vector<SceneEntry> all = scenes();
  const nlohmann::json json = nlohmann::json::parse(to_json(all)).at("scenes");
  ASSERT_EQ(json.size(), all.size());
  const std::string text = to_text(all);
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(json[i].at("name"), all[i].name);
    EXPECT_EQ(json[i].at("effects"), all[i].effects);
    EXPECT_NE(text.find(all[i].name), std::string::npos);
    EXPECT_NE(text.find(all[i].title), std::string::npos);
  }
}

}  // namespace
}  // namespace hbvm
