#include "scene/coordinate_names.hpp"

#include <gtest/gtest.h>

#include "scene/assemble.hpp"

namespace hbvm::core {
namespace {

using NameList = std::vector<std::string>;

TEST(CoordinateNames, NameBodiesInOrder) {
  const Scene scene = load_scene("double_pendulum");
  EXPECT_EQ(coordinate_names(scene), (NameList{"a.x", "a.y", "b.x", "b.y"}));
  EXPECT_EQ(coordinate_names(scene, "p"), (NameList{"a.px", "a.py", "b.px", "b.py"}));
}

TEST(CoordinateNames, NameDirectorsAndAReferencePointThatMoves) {
  NameList top{"top.d1.x", "top.d1.y", "top.d1.z", "top.d2.x", "top.d2.y",
               "top.d2.z", "top.d3.x", "top.d3.y", "top.d3.z"};
  EXPECT_EQ(coordinate_names(load_scene("heavy_top")), top);
  Scene free = load_scene("heavy_top");
  free.rigid_bodies.front().fixed = false;
  top.insert(top.begin(), {"top.x", "top.y", "top.z"});
  EXPECT_EQ(coordinate_names(free), top);
}

TEST(CoordinateNames, AreAsManyAsCoordinatesInEveryScene) {
  for (const auto& [name, text] : built_in_scenes()) {
    const Scene scene = load_scene(name);
    EXPECT_EQ(static_cast<Index>(coordinate_names(scene).size()), assemble<double>(scene).problem.m()) << name;
  }
}

}  // namespace
}  // namespace hbvm::core
