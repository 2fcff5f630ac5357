#include "scene/moving_point.hpp"

#include <gtest/gtest.h>

#include "scene/assemble.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

std::string scene_with_point(const std::string& rest, const std::string& point = "[\"sin(t)\", 0]") {
  return "title = \"A\"\ndimension = 2\n[[point]]\nname = \"still\"\nposition = [1, 2]\n[[point]]\nname = \"p\"\n"
         "position = " +
         point + "\n[[body]]\nname = \"a\"\nmass = 1\nposition = [0, -1]\nvelocity = [1, 0]\n" + rest;
}

const std::string rod_to_point = "[[constraint]]\nkind = \"rod\"\nbetween = [\"p\", \"a\"]\nlength = 1\n";

TEST(MovingPoint, NamesTheTime) {
  const Scene scene = read_scene(scene_with_point(""), "a");
  EXPECT_FALSE(moves(scene.points[0], scene.constants));
  EXPECT_TRUE(moves(scene.points[1], scene.constants));
  EXPECT_TRUE(names_work(scene));
  EXPECT_EQ(body_coordinates(scene), 2U);
  EXPECT_EQ(first_coordinate(scene.points[1], scene), 4U);
  // A constant of that name is none.
  const Scene constant = read_scene(
      "title = \"A\"\ndimension = 1\n[constants]\nt = 2\n[[point]]\nname = \"p\"\nposition = "
      "[\"t\"]\n[[body]]\nname = \"a\"\nmass = 1\nposition = [1]\nvelocity = [0]\n",
      "a");
  EXPECT_FALSE(moves(constant.points[0], constant.constants));
  EXPECT_FALSE(names_work(constant));
}

TEST(MovingPoint, CarriesWhatHangsOnIt) {
  const Assembled<double> scene = assemble<double>(read_scene(scene_with_point(rod_to_point), "a"));
  EXPECT_EQ(scene.problem.m(), 6);
  EXPECT_EQ(scene.problem.mass.of_bodies(), 2);
  EXPECT_EQ(scene.problem.driven.back().name, "point 'p'");
  EXPECT_EQ(degree_of_g(scene.problem), Trace<double>::not_polynomial);
}

/// The velocity of the body must fit that of the point: |a - p| changes at the rate (a - p).(v - p').
TEST(MovingPoint, NeedsAConsistentStart) {
  const std::string turned = scene_with_point(rod_to_point, "[0, \"t\"]");
  expect_words(message_of([&] { assemble<double>(read_scene(turned, "a")); }),
               {"velocity", "not consistent", "rod 'p'-'a'"});
}

TEST(MovingPoint, OnesCannotBeJoined) {
  const std::string both = "[[constraint]]\nkind = \"rod\"\nbetween = [\"p\", \"still\"]\nlength = 1\n";
  expect_words(message_of([&] { read_scene(scene_with_point(both), "a"); }), {"points whose motion is given"});
}

TEST(MovingPoint, WritesScenesOfForcesBack) {
  const std::string effects =
      rod_to_point +
      "[[effect]]\nkind = \"spring\"\nbetween = [\"still\", \"a\"]\nstiffness = 2\ndamping = \"1 + t\"\n"
      "[[effect]]\nkind = \"drag\"\nlinear = 1\n[[effect]]\nkind = \"force\"\nof = [\"a\"]\nF = [\"a.vx*t\", \"a.m\"]\n"
      "[[effect]]\nkind = \"formula\"\nU = \"x*t\"\n";
  const Scene scene = read_scene(scene_with_point(effects), "a");
  ASSERT_EQ(scene.effects.size(), 5U);
  EXPECT_EQ(scene.effects[1].kind, "damper");
  const std::string once = write_scene(scene);
  EXPECT_EQ(write_scene(read_scene(once, "a")), once);
}

TEST(MovingPoint, WrongForcesAreRefused) {
  const auto message = [](const std::string& effect) {
    return message_of([&] { assemble<double>(read_scene(scene_with_point("[[effect]]\n" + effect), "a")); });
  };
  expect_words(message("kind = \"drag\"\nlinear = \"x\"\n"), {"'linear'", "unknown name 'x'"});
  expect_words(message("kind = \"drag\"\nlinear = \"1 +\"\n"), {"'linear'"});
  expect_words(message("kind = \"damper\"\ncoefficient = 1\n"), {"between"});
  expect_words(message("kind = \"torque\"\non = \"a\"\nvalue = 1\n"), {"'a' is no rigid body"});
  expect_words(message("kind = \"magnetic_field\"\nB = 1\n"), {"it acts on nobody"});
  expect_words(message("kind = \"magnetic_field\"\nB = [1, 2, 3]\n"), {"'B'", "a number or a formula"});
  expect_words(message("kind = \"rotating_frame\"\nomega = \"t\"\n"), {"constant rate"});
  expect_words(message("kind = \"force\"\nF = [\"1/(1 + y)\", 0]\n"), {"no value at the start"});
  expect_words(message("kind = \"force\"\nF = [1]\n"), {"'F' must have 2 components"});
  expect_words(message("kind = \"dragg\"\nlinear = 1\n"), {"did you mean 'drag'"});
}

}  // namespace
}  // namespace hbvm::core
