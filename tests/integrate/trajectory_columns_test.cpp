#include "integrate/trajectory_columns.hpp"

#include <gtest/gtest.h>

#include "scene/observe.hpp"

namespace hbvm::core {
namespace {

using Names = std::vector<std::string>;

TEST(TrajectoryColumns, AreNamedAfterBodiesAndMultipliers) {
  const auto columns = trajectory_columns(load_scene("double_pendulum"), {"rod O-a", "rod a-b"});
  EXPECT_EQ(names_of(columns), (Names{"t",
                                      "a.x",
                                      "a.y",
                                      "b.x",
                                      "b.y",
                                      "a.px",
                                      "a.py",
                                      "b.px",
                                      "b.py",
                                      "lambda1",
                                      "lambda2",
                                      "output.a.px",
                                      "output.a.py",
                                      "output.b.px",
                                      "output.b.py",
                                      "output.lambda1",
                                      "output.lambda2",
                                      "delta_H",
                                      "g",
                                      "hidden"}));
  EXPECT_NE(columns[10].description.find("'rod a-b'"), std::string::npos) << columns[10].description;
  for (const TrajectoryColumn& column : columns) EXPECT_FALSE(column.description.empty()) << column.name;
}

TEST(TrajectoryColumns, StayOnOneLine) {
  Scene scene = load_scene("simple_pendulum");
  scene.bodies.front().name = "a,\n\r\"b\"";
  const Names names = names_of(trajectory_columns(scene, {}));
  EXPECT_EQ(names[1], "a,  \"b\".x");
  EXPECT_EQ(names.size(), 1u + 2 + 2 + 2 + 3);
}

TEST(TrajectoryColumns, EndWithWhatIsObserved) {
  const Scene scene = with_observation(load_scene("kepler"), "r", "distance(sun, planet)");
  const auto columns = trajectory_columns(scene, {});
  EXPECT_EQ(columns.back().name, "r");
  EXPECT_NE(columns.back().description.find("distance(sun, planet)"), std::string::npos);
  for (const char* const taken : {"t", "g", "planet.x", "delta_H"})
    EXPECT_THROW(trajectory_columns(with_observation(scene, taken, "planet.y"), {}), InputError);
}

}  // namespace
}  // namespace hbvm::core
