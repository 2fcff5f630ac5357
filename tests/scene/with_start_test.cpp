#include "scene/with_start.hpp"

#include "printing.hpp"
#include "scene/project.hpp"

namespace hbvm::core {
namespace {

const std::string pendulum_with_comments = R"toml(# A pendulum of mine, héllo.
title = "Pendulum"   # in class
dimension = 2
point = [{ name = "O", position = [0, 0] }]

[[body]]
name = "bob"         # on a rod
mass = "sqrt(2)"
position = [
  0.9,               # to the right,
  "-6/5"             # and down
]
velocity = [1, 0]    # m/s

[[constraint]]
kind = "rod"
between = ["O", "bob"]
length = 1
)toml";

Scene start_of(const std::string& text) {
  Scene scene = read_scene(text, "test.toml");
  scene.bodies[0].position = {Expression::parse("0.6"), Expression::parse("-0.8")};
  return scene;
}

TEST(WithStart, LeavesAllButTheStartAsItIs) {
  std::string expected = pendulum_with_comments;
  expected.replace(expected.find("0.9"), 3, "\"0.6\"");
  expected.replace(expected.find("\"-6/5\""), 6, "\"-0.8\"");
  EXPECT_EQ(with_start(pendulum_with_comments, start_of(pendulum_with_comments)), expected);
  EXPECT_EQ(with_start(expected, start_of(expected)), expected) << "what is there already stays";
}

TEST(WithStart, FindsPlacesBehindCharactersOfSeveralBytesAndAByteOrderMark) {
  const std::string mark = "\xEF\xBB\xBF";
  const std::string line =
      "body = [{ name = \"b\xC3\xB6\xE2\x82\xAC\", mass = 1, position = [1, 2.5e0], momentum = [\"1/3\", -1_0] }]\n";
  const std::string text = mark + "dimension = 2\n" + line;
  Scene scene = read_scene(text, "test.toml");
  scene.bodies[0].position[1] = Expression::parse("3");
  scene.bodies[0].momentum[1] = Expression::parse("7");
  const std::string edited = with_start(text, scene);
  EXPECT_NE(edited.find("position = [1, \"3\"], momentum = [\"1/3\", \"7\"] }]"), std::string::npos) << edited;
}

/// A body that is turned by angles gets directors in their place, if they changed; then they are those of the scene.
TEST(WithStart, PutsDirectorsWhereAnglesStood) {
  const std::string text =
      "dimension = 2\n[[rigid_body]]\nname = \"bar\"\nfixed_at = [0, 0]\nmass = 1\ninertia = 1\n"
      "orientation = 0.3   # a little\nangular_velocity = 1\n";
  Scene scene = read_scene(text, "test.toml");
  EXPECT_EQ(with_start(text, scene), text);
  scene.rigid_bodies[0].directors[0][1] = Expression::parse("1/2");
  const std::string edited = with_start(text, scene);
  EXPECT_NE(edited.find("orientation = { directors = ["), std::string::npos) << edited;
  EXPECT_NE(edited.find("# a little"), std::string::npos) << edited;
  EXPECT_EQ(write_scene(read_scene(edited, "test.toml")), write_scene(scene));
}

/// What is written is the projected scene, whatever the scene: bodies and rigid ones, in the plane and in space.
TEST(WithStart, WritesWhatProjectionGives) {
  for (const auto& [name, text] : built_in_scenes()) {
    SCOPED_TRACE(name);
    Scene moved = read_scene(text, name);
    for (SceneBody& body : moved.bodies)
      body.position[0] = Expression::parse("1.0009765625*(" + body.position[0].text() + ")");
    for (SceneRigidBody& body : moved.rigid_bodies)
      if (!body.fixed) body.position[0] = Expression::parse("1.0009765625*(" + body.position[0].text() + ")");
    const Scene projected = project<double>(moved);
    EXPECT_EQ(write_scene(read_scene(with_start(text, projected), name)), write_scene(projected));
  }
}

}  // namespace
}  // namespace hbvm::core
