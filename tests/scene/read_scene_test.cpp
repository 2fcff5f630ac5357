#include <fstream>

#include "printing.hpp"
#include "scalar/literal.hpp"
#include "scene/joined_bodies.hpp"
#include "scene/scene.hpp"
#include "scene/scene_text.hpp"

namespace hbvm::core {
namespace {

class ReadScene : public InDigits<50> {
 protected:
  void expect_numbers(const SceneVector& v, const std::vector<const char*>& expected) const {
    ASSERT_EQ(v.size(), expected.size());
    for (std::size_t i = 0; i < v.size(); ++i) EXPECT_EQ(value(v[i], scene), literal<Mpfr>(expected[i])) << i;
  }
  void expect_numbers(const SceneMatrix& a, const std::vector<std::vector<const char*>>& expected) const {
    ASSERT_EQ(a.size(), expected.size());
    for (std::size_t i = 0; i < a.size(); ++i) expect_numbers(a[i], expected[i]);
  }
  void expect_number(const std::optional<Expression>& e, const char* expected) const {
    ASSERT_TRUE(e.has_value());
    EXPECT_EQ(value(*e, scene), literal<Mpfr>(expected));
  }
  void expect_numbers(const SceneEffect& effect, const std::map<std::string, const char*>& expected) const {
    EXPECT_EQ(effect.numbers.size(), expected.size());
    for (const auto& [key, text] : expected) {
      ASSERT_TRUE(effect.numbers.contains(key)) << key;
      EXPECT_EQ(value(effect.numbers.at(key), scene), literal<Mpfr>(text)) << key;
    }
  }

  Scene scene = read_scene(every_key, "every_key.toml");
};

TEST_F(ReadScene, Header) {
  EXPECT_EQ(scene.name, "every_key.toml");
  EXPECT_EQ(scene.title, "Every key");
  EXPECT_EQ(scene.source, "made up");
  EXPECT_EQ(scene.dimension, 3);
  ASSERT_EQ(scene.constants.size(), 2u);
  EXPECT_EQ(value(scene.constants.at("unit"), scene), 1);
}

TEST_F(ReadScene, Points) {
  ASSERT_EQ(scene.points.size(), 2u);
  EXPECT_EQ(scene.points[0].name, "pivot");
  EXPECT_FALSE(scene.points[0].charge);
  EXPECT_EQ(scene.points[1].name, "charge");
  expect_numbers(scene.points[1].position, {"2", "1/2", "1/4"});
  expect_number(scene.points[1].charge, "-1");
  EXPECT_EQ(scene.points[1].line, line_of(every_key, "name = \"charge\"") - 1);
}

TEST_F(ReadScene, Bodies) {
  ASSERT_EQ(scene.bodies.size(), 3u);
  const SceneBody &a = scene.bodies[0], &b = scene.bodies[1], &c = scene.bodies[2];
  EXPECT_EQ(a.name, "a");
  expect_number(a.mass, "2");
  EXPECT_FALSE(a.mass_matrix);
  expect_numbers(a.position, {"3/5", "0", "-4/5"});
  expect_numbers(a.velocity, {"2/5", "0", "3/10"});
  EXPECT_TRUE(a.momentum.empty());
  expect_number(a.charge, "3/2");
  EXPECT_EQ(a.line, line_of(every_key, "[[body]]"));

  EXPECT_FALSE(b.mass);
  ASSERT_TRUE(b.mass_matrix);
  expect_numbers(*b.mass_matrix, {{"2", "1/4", "0"}, {"1/4", "1", "0"}, {"0", "0", "1"}});
  EXPECT_TRUE(b.velocity.empty());
  expect_numbers(b.momentum, {"87/16", "-3/2", "9/8"});
  EXPECT_FALSE(b.charge);

  expect_number(c.mass, "1");
}

TEST_F(ReadScene, RigidBodies) {
  ASSERT_EQ(scene.rigid_bodies.size(), 2u);
  const SceneRigidBody &top = scene.rigid_bodies[0], &stone = scene.rigid_bodies[1];
  EXPECT_EQ(top.name, "top");
  EXPECT_TRUE(top.fixed);
  expect_numbers(top.position, {"0", "1", "1/2"});
  EXPECT_TRUE(top.velocity.empty());
  EXPECT_EQ(value(top.mass, scene), 3);
  expect_numbers(top.center, {"1/10", "1/5", "1"});
  expect_numbers(top.second_moment, {{"2", "1/4", "1/5"}, {"1/4", "3/2", "-1/3"}, {"1/5", "-1/3", "4"}});
  expect_numbers(top.directors, {{"2/3", "2/3", "1/3"}, {"-2/3", "1/3", "2/3"}, {"1/3", "-2/3", "2/3"}});
  expect_numbers(top.angular_velocity, {"1/2", "1", "-1/2"});

  EXPECT_EQ(stone.name, "stone");
  EXPECT_FALSE(stone.fixed);
  expect_numbers(stone.position, {"5", "6", "7"});
  expect_numbers(stone.velocity, {"1", "-1", "1/3"});
  EXPECT_EQ(stone.line, line_of(every_key, "name = \"stone\"") - 1);
}

TEST_F(ReadScene, Constraints) {
  ASSERT_EQ(scene.constraints.size(), 4u);
  const auto& [rod, quadric, plane, angle] =
      std::tie(scene.constraints[0], scene.constraints[1], scene.constraints[2], scene.constraints[3]);
  using Names = std::array<std::string, 2>;
  EXPECT_EQ(rod.kind, "rod");
  EXPECT_EQ(rod.pairs.at("between"), (Names{"pivot", "a"}));
  expect_number(rod.numbers.at("length"), "1");

  EXPECT_EQ(quadric.kind, "quadric");
  EXPECT_EQ(quadric.bodies.at("body"), "b");
  expect_numbers(quadric.matrices.at("A"), {{"1", "1/4", "0"}, {"1/4", "2", "0"}, {"0", "0", "1"}});
  expect_numbers(quadric.vectors.at("b"), {"1/2", "0", "-1"});
  expect_number(quadric.numbers.at("c"), "-4");

  EXPECT_EQ(plane.kind, "plane");
  EXPECT_EQ(plane.bodies.at("body"), "c");
  expect_numbers(plane.vectors.at("normal"), {"1", "2", "2"});
  expect_number(plane.numbers.at("offset"), "3");

  EXPECT_EQ(angle.kind, "angle");
  EXPECT_EQ(angle.pairs.at("first"), (Names{"a", "pivot"}));
  EXPECT_EQ(angle.pairs.at("second"), (Names{"c", "b"}));
  expect_number(angle.numbers.at("value"), "4/5");
  EXPECT_EQ(angle.line, line_of(every_key, "kind = \"angle\"") - 1);
}

TEST_F(ReadScene, Effects) {
  ASSERT_EQ(scene.effects.size(), 10u);
  const auto& e = scene.effects;
  const std::vector<const char*> kinds{"uniform_gravity", "central_gravity", "mutual_gravity", "coulomb",
                                       "spring",          "spring",          "trap",           "lennard_jones",
                                       "radial_cosine",   "oblateness"};
  for (std::size_t i = 0; i < kinds.size(); ++i) EXPECT_EQ(e[i].kind, kinds[i]);
  using On = std::vector<std::string>;
  using Pairs = std::vector<std::pair<std::string, std::string>>;

  expect_numbers(e[0], {});
  expect_numbers(e[0].vectors.at("acceleration"), {"0", "-1/7", "-1"});
  EXPECT_FALSE(e[0].on);

  expect_numbers(e[1], {{"strength", "3/10"}});
  EXPECT_EQ(e[1].center, "pivot");
  EXPECT_EQ(e[1].on, (On{"a", "c"}));

  expect_numbers(e[2], {{"strength", "1/5"}});
  EXPECT_EQ(e[2].between, (Pairs{{"a", "c"}}));

  expect_numbers(e[3], {{"strength", "7/10"}});
  EXPECT_FALSE(e[3].between);

  expect_numbers(e[4], {{"stiffness", "5/4"}, {"rest_length", "1/3"}, {"exponent", "4"}});
  EXPECT_EQ(e[4].between, (Pairs{{"a", "b"}, {"c", "charge"}}));

  expect_numbers(e[6], {{"stiffness", "1/20"}, {"exponent", "4"}});
  EXPECT_EQ(e[6].center, "charge");
  EXPECT_FALSE(e[6].on);

  expect_numbers(e[7], {{"depth", "1/100"}, {"diameter", "9/10"}});
  expect_numbers(e[8], {{"strength", "1/2"}});

  expect_numbers(e[9], {{"strength", "3/2"}, {"radius", "1/2"}, {"J2", "27/25000"}});
  expect_numbers(e[9].vectors.at("axis"), {"1", "2", "2"});
  EXPECT_EQ(e[9].on, (On{"a"}));
  EXPECT_EQ(e[9].line, line_of(every_key, "kind = \"oblateness\"") - 1);
}

TEST_F(ReadScene, AbsentRestLengthIsZeroAndAbsentExponentTwo) {
  expect_numbers(scene.effects[5], {{"stiffness", "2"}, {"rest_length", "0"}, {"exponent", "2"}});
}

TEST_F(ReadScene, TitleAndSourceMayBeAbsent) {
  std::string text = changed(every_key, "title = \"Every key\"\n", "");
  text = changed(text, "source = \"made up\"\n", "");
  EXPECT_EQ(refusal(text), "");
}

using ReadDecimals = ReadScene;

/// The decimal as it stands is read, never a double next to it.
TEST_F(ReadDecimals, AreExact) {
  const std::pair<const char*, const char*> decimals[] = {
      {"mass = 0.1", "1/10"},
      {"mass=0.1", "1/10"},
      {"mass = 0.1234567890123456789012345678901234567890123", "1234567890123456789012345678901234567890123/10^43"},
      {"mass = 6.25e-2", "1/16"},
      {"mass = 1E-3", "1/1000"},
      {"mass = 1.1e+1", "11"},
      {"mass = +0.3", "3/10"},
      {"mass = -0.3", "-3/10"},
      {"mass = 1_000.000_1", "10000001/10000"},
      {"mass\t=\t0.7\t# and a comment", "7/10"},
      {R"(mass = "0.1")", "1/10"},
      {R"(mass = "0.1 + 0.2")", "3/10"},
      {"mass = \"sqrt(1/2)\"", "2^(-1/2)"},
      {R"(mass = "L^2")", "1/4"},
      {"mass = 1_000", "1000"},
      {"mass = 0xff", "255"},
      {"mass = 1e-400", "10^-400"}};
  for (const auto& [line, expected] : decimals) {
    SCOPED_TRACE(line);
    scene = read_scene(changed(every_key, "mass = 2", line), "test.toml");
    expect_number(scene.bodies[0].mass, expected);
  }
}

TEST_F(ReadDecimals, AreExactAfterOtherCharactersInTheSameLine) {
  const std::string text =
      "dimension = 2\n\"point\" = [{name = \"Ω→𝄞é\", position = [0.1, -0.7]}]\n"
      "body = [{name = \"日本\", mass = 0.3, position = [1.1e1, 0.1_1], velocity = [0, 0.9]}]\n";
  scene = read_scene(text, "test.toml");
  EXPECT_EQ(scene.points[0].name, "Ω→𝄞é");
  expect_numbers(scene.points[0].position, {"1/10", "-7/10"});
  expect_number(scene.bodies[0].mass, "3/10");
  expect_numbers(scene.bodies[0].position, {"11", "11/100"});
  expect_numbers(scene.bodies[0].velocity, {"0", "9/10"});
}

TEST_F(ReadDecimals, AreExactAfterCarriageReturns) {
  std::string text;
  for (const char c : every_key) text += c == '\n' ? std::string("\r\n") : std::string(1, c);
  scene = read_scene(text, "test.toml");
  expect_number(scene.effects[1].numbers.at("strength"), "3/10");
}

TEST_F(ReadDecimals, AreExactInTheLineOfALeadingByteOrderMark) {
  const std::string rest = changed(every_key, "[constants]\nL = \"1/2\"\nunit = \"2*L\"\n", "");
  scene = read_scene("\xEF\xBB\xBF" + ("constants = {x = 0.1}\n" + rest), "test.toml");
  expect_number(scene.constants.at("x"), "1/10");
}

TEST(LoadScene, ReadsAFile) {
  const std::string path = ::testing::TempDir() + "hbvm_load_scene_test.toml";
  std::ofstream(path) << every_key;
  const Scene scene = load_scene(path);
  EXPECT_EQ(scene.name, path);
  EXPECT_EQ(scene.title, "Every key");
}

TEST(LoadScene, NamesTheFileInMessages) {
  const std::string path = ::testing::TempDir() + "hbvm_malformed_scene_test.toml";
  std::ofstream(path) << changed(every_key, "mass = 3", "mass = true");
  const std::string message = refused([&] { load_scene(path); });
  EXPECT_TRUE(message.starts_with(path + ":" + std::to_string(line_of(every_key, "mass = 3")) + ": ")) << message;
}

TEST(LoadScene, RefusesWhatIsNeitherFileNorName) {
  for (const char* name : {"no_such_scene", "", "/", "/tmp", "/nonexistent/scene.toml"})
    EXPECT_THROW(load_scene(name), InputError) << name;
}

TEST(LoadScene, SuggestsTheNearestName) {
  expect_words(refused([] { load_scene("conical_pendulm"); }), {"'conical_pendulum'"});
}

TEST(BuiltInScenes, AreThePapersFour) {
  for (const char* name : {"simple_pendulum", "modified_pendulum", "conical_pendulum", "tethered_satellites"})
    EXPECT_EQ(load_scene(name).name, name);
}

/// Named attachments first, then those described in place, each once, in the order in which they are met.
TEST(ReadAttachments, ByNameAndInPlace) {
  const Scene scene = read_scene(joined_bodies, "joined.toml");
  const std::vector<std::string> names{"left",           "right",         "base[1, 0, 0]", "arm[0, -1/2, 0]",
                                       "arm[0, 1/2, 0]", "bob[0, 0, 0]",  "arm[1, 0, 0]",  "arm[0, 0, 0]",
                                       "bob[2, 0, -1]",  "base[0, 2, 0]", "arm[1/3, 0, 1]"};
  ASSERT_EQ(scene.attachments.size(), names.size());
  for (std::size_t i = 0; i < names.size(); ++i) EXPECT_EQ(scene.attachments[i].name, names[i]);
  EXPECT_EQ(scene.attachments[0].of, "bob");
  EXPECT_EQ(value(scene.attachments[0].at[0], scene), 3);
  ASSERT_TRUE(scene.attachments[1].charge);
  EXPECT_EQ(value(*scene.attachments[1].charge, scene), -1);
  EXPECT_EQ(scene.attachments[1].line, line_of(joined_bodies, "name = \"right\"") - 1);
  EXPECT_EQ(scene.attachments[3].of, "arm");
  EXPECT_EQ(scene.attachments[3].line, line_of(joined_bodies, "{ of = \"base\", at = [1, 0, 0] }"));
  using Names = std::array<std::string, 2>;
  EXPECT_EQ(scene.constraints[0].pairs.at("between"), (Names{"base[1, 0, 0]", "arm[0, -1/2, 0]"}));
  EXPECT_TRUE(scene.constraints[0].has("second_axis"));
  EXPECT_EQ(scene.constraints[2].pairs.at("between"), (Names{"left", "hook"}));
  EXPECT_EQ(*scene.effects[0].on, (std::vector<std::string>{"arm", "bob"}));
  EXPECT_EQ(scene.effects[3].on->back(), "arm[1/3, 0, 1]");
}

TEST(ReadAttachments, AChargeCountsWhereverThePointStands) {
  const std::string text = changed(joined_bodies, "on = [\"bead\", { of = \"arm\", at = [\"1/3\", 0, 1] }]",
                                   "on = [{ of = \"arm\", at = [0, \"1/2\", 0], charge = 5 }]");
  const Scene scene = read_scene(text, "joined.toml");
  ASSERT_TRUE(scene.attachments[4].charge);
  EXPECT_EQ(value(*scene.attachments[4].charge, scene), 5);
}

TEST(ReadRigidBody, InThePlaneTurnsAtANumber) {
  const Scene scene = load_scene("double_physical_pendulum");
  const SceneRigidBody& lower = scene.rigid_bodies[1];
  ASSERT_EQ(lower.angular_velocity.size(), 1u);
  EXPECT_EQ(value(lower.angular_velocity[0], scene), -1);
  EXPECT_EQ(lower.directors.size(), 2u);
  EXPECT_EQ(lower.second_moment[1].size(), 2u);
}

}  // namespace
}  // namespace hbvm::core
