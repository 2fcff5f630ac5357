#include "scene/shape.hpp"

#include <gtest/gtest.h>

#include "scene/assemble.hpp"
#include "scene_text.hpp"

namespace hbvm::core {
namespace {

const std::string in_space = R"(dimension = 3
[constants]
R = "1/2"
[[rigid_body]]
name = "wheel"
position = [0, 0, 0]
velocity = [0, 0, 0]
mass = 1
inertia = [1, 1, 1]
orientation = { axis = [1, 0, 0], angle = 0 }
angular_velocity = [0, 0, 1]
)";
const std::string in_plane = R"(dimension = 2
[[rigid_body]]
name = "wheel"
position = [0, 0]
velocity = [0, 0]
mass = 1
inertia = 1
orientation = 0
angular_velocity = 1
)";

SceneShape shape_of(const std::string& text) { return *read_scene(text, "test.toml").rigid_bodies.front().shape; }

TEST(Shape, IsReadAndWrittenBack) {
  const std::vector<std::string> both{"{ box = [1, 2, \"R\"], at = [0, \"R/2\", 1] }", "{ cylinder = [\"R\", 2] }",
                                      "{ disc = \"R\", axis = [0, 1, 0] }", "{ ring = 0.25 }", "{ sphere = 2 }"};
  for (const std::string& shape : both) {
    const Scene scene = read_scene(in_space + "shape = " + shape + "\n", "test.toml");
    const std::string written = write_scene(scene);
    const SceneShape read = *scene.rigid_bodies.front().shape, again = shape_of(written);
    EXPECT_EQ(again.kind, read.kind);
    EXPECT_EQ(write_scene(read_scene(written, "test.toml")), written);
    EXPECT_EQ(again.sizes.size(), read.sizes.size());
    EXPECT_EQ(again.axis.size(), read.axis.size());
    EXPECT_EQ(again.at.size(), read.at.size());
  }
  const SceneShape box = shape_of(in_space + "shape = " + both.front());
  EXPECT_EQ(box.kind, "box");
  EXPECT_EQ(box.sizes[2].text(), "R");
  EXPECT_EQ(box.at[1].text(), "R/2");
  EXPECT_EQ(shape_of(in_plane + "shape = { box = [1, 2] }").sizes.size(), 2u);
  EXPECT_FALSE(read_scene(in_plane, "test.toml").rigid_bodies.front().shape);
}

TEST(Shape, IsRefusedWithItsLine) {
  const auto in_line = [](const std::string& text, const std::string& shape) {
    const std::string message = refusal(text + "shape = " + shape + "\n");
    EXPECT_EQ(message.find("test.toml:" + std::to_string(line_of(text + "shape", "shape"))), 0u) << message;
    return message;
  };
  expect_words(in_line(in_space, "3"), {"'shape' must be a table", "'box'", "'cylinder'", "'sphere'"});
  expect_words(in_line(in_space, "{ box = [1, 2] }"),
               {"rigid_body 'wheel', shape", "'box' has 2 entries instead of 3"});
  expect_words(in_line(in_space, "{ box = [1, 2, 0] }"), {"'box' must be positive"});
  expect_words(in_line(in_space, "{ disc = \"R - 1\" }"), {"'disc' must be positive"});
  expect_words(in_line(in_space, "{ disc = 1, axis = [0, 0, 0] }"), {"'axis' must not be 0"});
  expect_words(in_line(in_space, "{ disc = 1, ring = 1 }"), {"give 'disc' or 'ring', not both"});
  expect_words(in_line(in_space, "{ sphere = 1, axis = [0, 0, 1] }"), {"unknown key 'axis'"});
  expect_words(in_line(in_space, "{ dics = 1 }"), {"unknown key 'dics'", "disc"});
  expect_words(in_line(in_space, "{ at = [0, 0, 0] }"), {"'box'", "missing"});
  expect_words(in_line(in_plane, "{ sphere = 1 }"), {"no 'sphere' in the plane", "'box', 'disc' or 'ring'"});
  expect_words(in_line(in_plane, "{ disc = 1, axis = [0, 1] }"), {"unknown key 'axis'"});
}

/// It is drawn, and no more.
TEST(Shape, MovesNothing) {
  const Assembled<double> plain = assemble<double>(read_scene(in_space, "test.toml")),
                          shaped = assemble<double>(read_scene(in_space + "shape = { sphere = 7 }", "test.toml"));
  EXPECT_EQ(plain.q0, shaped.q0);
  EXPECT_EQ(plain.p0, shaped.p0);
}

}  // namespace
}  // namespace hbvm::core
