#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "hbvm/error.hpp"
#include "hbvm/scene.hpp"

namespace hbvm {
namespace {

/// A triangle of rods, of which one is named twice, a charge beside it, and gravity.
Scene triangle() {
  Scene scene(2, "triangle");
  scene.body({.name = "a", .position = {0, 0}, .velocity = {1, 0}, .charge = 1});
  scene.body({.name = "b", .mass = 3, .position = {2, 0}, .velocity = {1, 0}});
  scene.rod("a", "b", 2).rod("b", "a", 2).effect({.kind = "uniform_gravity", .vectors = {{"acceleration", {0, -1}}}});
  scene.effect({.kind = "trap", .numbers = {{"stiffness", 1}, {"exponent", 4}}, .center = "o", .on = {"a"}});
  return scene.point("o", {0, 5});
}

TEST(DoorFacts, CountsAndNamesWhatIsThere) {
  const SceneFacts facts = describe(triangle());
  EXPECT_EQ(facts.coordinates, (std::vector<std::string>{"a.x", "a.y", "b.x", "b.y"}));
  EXPECT_EQ(facts.constraints, (std::vector<std::string>{"rod 'a'-'b'", "rod 'b'-'a'"}));
  EXPECT_EQ(facts.redundant, std::vector<long>{2});
  EXPECT_EQ(facts.redundancies.size(), 1u);
  EXPECT_EQ(facts.degrees_of_freedom, 3);
  EXPECT_EQ(facts.degree_of_g, 2);
  EXPECT_EQ(facts.degree_of_U, 4);
  ASSERT_EQ(facts.effects.size(), 2u);
  EXPECT_TRUE(facts.effects[0].constant_force);
  EXPECT_EQ(facts.effects[1].on, (std::vector<std::vector<std::string>>{{"a"}}));
  ASSERT_EQ(facts.effects[1].not_on.size(), 1u);
  EXPECT_EQ(facts.effects[1].not_on[0].first, "b");
}

TEST(DoorFacts, HoldWhatIsObservedAtTheStart) {
  Scene scene = triangle();
  scene.observe("width", "2*distance(a, b)");
  const SceneFacts facts = describe(scene, "mpfr:40");
  ASSERT_EQ(facts.observed.size(), 1u);
  EXPECT_EQ(facts.observed[0].value, "4");
  EXPECT_NE(to_text(facts).find("width = 4, 2*distance(a, b)"), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(to_json(facts)).at("observed").at("width").at("value"), "4");
  EXPECT_THROW(describe(triangle().observe("x", "c.x")), InputError);
}

/// T = (1 + 3)/2, the potential energies are 0 of gravity and 5^4/4 of the trap.
TEST(DoorFacts, KnowsTheEnergyToTheDigitsAskedFor) {
  const SceneFacts facts = describe(triangle(), "mpfr:40");
  EXPECT_EQ(facts.kinetic, "2");
  EXPECT_EQ(facts.potential, "156.25");
  EXPECT_EQ(facts.energy, "158.25");
}

TEST(DoorFacts, SaysWhichMomentaAreConserved) {
  const SceneFacts facts = describe(Scene(2, "free").body({.name = "a", .position = {1, 0}, .velocity = {0, 2}}));
  ASSERT_GE(facts.momenta.size(), 3u);
  for (const SceneFacts::Momentum& momentum : facts.momenta) EXPECT_TRUE(momentum.conserved) << momentum.name;
  EXPECT_FALSE(facts.gram_condition);
  EXPECT_EQ(facts.degree_of_U, 0);
}

TEST(DoorFacts, AreTextAndJson) {
  const SceneFacts facts = describe(triangle());
  const nlohmann::json json = nlohmann::json::parse(to_json(facts));
  EXPECT_EQ(json.at("coordinates"), facts.coordinates);
  EXPECT_EQ(json.at("degree_of_U"), 4);
  EXPECT_EQ(json.at("energy"), facts.energy);
  EXPECT_EQ(json.at("effects")[1].at("not_on").at("b"), facts.effects[1].not_on[0].second);
  EXPECT_EQ(json.at("momenta").at("P_x").at("conserved"), false);
  const std::string text = to_text(facts);
  for (const char* const words : {"degrees of freedom    3", "g_1", "redundant", "q_3 = b.x", "polynomial of degree 4"})
    EXPECT_NE(text.find(words), std::string::npos) << words << " in\n" << text;
  const SceneFacts top = describe(load_scene("heavy_top"));
  EXPECT_EQ(nlohmann::json::parse(to_json(top)).at("rigid_bodies").at("top").at("inertia").size(), 3u);
  const SceneFacts ring = describe(load_scene("bead_on_torus"));
  EXPECT_TRUE(nlohmann::json::parse(to_json(ring)).at("degree_of_U").is_number());
  EXPECT_TRUE(nlohmann::json::parse(to_json(describe(load_scene("kepler")))).at("degree_of_U").is_null());
}

TEST(DoorFacts, RefusesWhatHasNoValue) {
  Scene scene(2, "together");
  for (const char* const name : {"a", "b"}) scene.body({.name = name, .position = {0, 0}});
  scene.effect({.kind = "mutual_gravity", .numbers = {{"strength", 1}}});
  EXPECT_THROW(describe(scene), InputError);
}

}  // namespace
}  // namespace hbvm
