#include "scene/observe.hpp"

#include <gtest/gtest.h>

#include "scene/set_number.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

TEST(Observe, AddsAnObservationThatReadsBack) {
  const Scene scene =
      with_observation(with_observation(load_scene("kepler"), "r", "distance(sun, planet)"), "planet.vx", "planet.vx");
  ASSERT_EQ(scene.observations.size(), 2u);
  EXPECT_EQ(scene.observations[0].name, "r");
  EXPECT_EQ(scene.observations[0].value.text(), "distance(sun, planet)");
  EXPECT_EQ(scene.observations[1].name, "planet.vx");
  EXPECT_EQ(settings_in_command(scene), " --observe 'r=distance(sun, planet)' --observe 'planet.vx'");
  const Scene read = read_scene(write_scene(scene), "again");
  ASSERT_EQ(read.observations.size(), 2u);
  EXPECT_EQ(read.observations[0].name, "r");
  EXPECT_EQ(read.observations[1].value.text(), "planet.vx");
}

TEST(Observe, IsRefusedWithWhatIsWrong) {
  const Scene scene = with_observation(load_scene("kepler"), "r", "distance(sun, planet)");
  expect_words(message_of<InputError>([&] { with_observation(scene, "r", "planet.x"); }), {"'r' is observed already"});
  expect_words(message_of<InputError>([&] { with_observation(scene, "", "planet.x"); }), {"without a name"});
  expect_words(message_of<InputError>([&] { with_observation(scene, "a", "planet.x +"); }), {"column 11"});
  expect_words(message_of<InputError>([&] { with_observation(scene, "a=b", "planet.x"); }), {"no '='", "a=b"});
  const auto read = [](const std::string& table) {
    return message_of<InputError>([&] {
      read_scene(
          "dimension = 2\nbody = [{ name = \"a\", mass = 1, position = [0, 0], velocity = [0, 0] }]\n[[observe]]\n" +
              table,
          "file.toml");
    });
  };
  expect_words(read("name = \"n\"\n"), {"file.toml:3", "observe", "'value' is missing"});
  expect_words(read("name = \"\"\nvalue = \"a.x\"\n"), {"file.toml:4", "'name' must not be empty"});
  expect_words(read("name = \"n\"\nvalue = \"a.x)\"\n"), {"file.toml:3", "column 4"});
  expect_words(read("name = \"n\"\nvalue = \"a.x\"\n[[observe]]\nname = \"n\"\nvalue = \"a.y\"\n"),
               {"file.toml:6", "observed already"});
}

}  // namespace
}  // namespace hbvm::core
