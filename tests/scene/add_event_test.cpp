#include "scene/add_event.hpp"

#include <gtest/gtest.h>

#include "scene/set_number.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

TEST(AddEvent, AddsEventsThatReadBack) {
  const Scene scene = with_event(with_event(load_scene("kepler"), "turn: planet.vx"), " far  down : planet.x - 1/3");
  ASSERT_EQ(scene.events.size(), 2u);
  EXPECT_EQ(scene.events[1].name, "far");
  EXPECT_EQ(settings_in_command(scene), " --event 'turn: planet.vx' --event ' far  down : planet.x - 1/3'");
  const Scene read = read_scene(write_scene(scene), "again");
  ASSERT_EQ(read.events.size(), 2u);
  EXPECT_EQ(read.events[0].direction, Crossing::any);
  EXPECT_EQ(read.events[1].direction, Crossing::down);
  EXPECT_EQ(read.events[1].value.text(), "planet.x - 1/3");
}

TEST(AddEvent, IsRefusedWithWhatIsWrong) {
  const Scene scene = with_event(load_scene("kepler"), "turn: planet.vx");
  const auto refused = [&](const std::string& text) {
    return message_of<InputError>([&] { with_event(scene, text); });
  };
  expect_words(refused("turn: planet.x"), {"'turn' already"});
  expect_words(refused("planet.x"), {"NAME: EXPRESSION"});
  expect_words(refused(": planet.x"), {"without a name"});
  expect_words(refused("a: planet.x +"), {"event 'a'", "column 11"});
  const auto read = [](const std::string& table) {
    return message_of<InputError>([&] {
      read_scene(
          "dimension = 2\nbody = [{ name = \"a\", mass = 1, position = [0, 0], velocity = [0, 0] }]\n[[event]]\n" +
              table,
          "file.toml");
    });
  };
  expect_words(read("name = \"n\"\n"), {"file.toml:3", "'value' is missing"});
  expect_words(read("name = \"n\"\nvalue = \"a.x\"\ndirection = \"left\"\n"), {"file.toml:", "\"up\"", "left"});
}

}  // namespace
}  // namespace hbvm::core
