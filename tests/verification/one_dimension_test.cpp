#include <gtest/gtest.h>

#include "hbvm/error.hpp"
#include "hbvm/reference.hpp"
#include "hbvm/run.hpp"
#include "words.hpp"

namespace hbvm {
namespace {

/// Three bodies on a line, with springs, charges, a formula, a trap and a rod; in the plane they are held to the line.
Scene on_a_line(int dimension) {
  const auto at = [&](const Number& x) { return dimension == 1 ? Numbers{x} : Numbers{x, 0}; };
  Scene scene(dimension, "line");
  scene.point("wall", at(0));
  const std::string names[] = {"a", "b", "c"};
  const Number places[] = {1, "23/10", "33/10"}, velocities[] = {"1/2", "-1/4", "-1/4"}, masses[] = {1, "5/2", "1/3"};
  for (int i = 0; i < 3; ++i)
    scene.body({.name = names[i],
                .mass = masses[i],
                .position = at(places[i]),
                .velocity = at(velocities[i]),
                .charge = Number(1)});
  scene.effect({.kind = "spring", .numbers = {{"stiffness", 2}, {"rest_length", "1/2"}}, .between = {{"wall", "a"}}});
  scene.effect({.kind = "coulomb", .numbers = {{"strength", "1/3"}}});
  scene.effect({.kind = "trap", .numbers = {{"stiffness", "1/5"}, {"exponent", 4}}, .center = "wall"});
  scene.effect({.kind = "uniform_gravity", .vectors = {{"acceleration", at("-1/7")}}});
  scene.effect({.kind = "formula", .on = {"c"}, .U = "-cos(x)"});
  scene.rod("b", "c", 1);
  if (dimension == 2)
    for (const char* const name : {"a", "b"})
      scene.constraint(
          {.kind = "plane", .names = {{"body", {name}}}, .numbers = {{"offset", 0}}, .vectors = {{"normal", {0, 1}}}});
  return scene;
}

/// The same numbers to round-off, whichever the precision and the method.
TEST(OneDimension, IsTheMotionOnALineOfThePlane) {
  for (const char* precision : {"double", "quad", "mpfr:40"})
    for (const char* method : {"hbvm:4,2", "hbvm:auto,3", "rattle", "rk4+project", "hbvm:3,3"}) {
      const auto made = [&](int dimension) {
        return run(
            {.scene = on_a_line(dimension), .method = method, .step = "1/32", .until = 1, .precision = precision});
      };
      const hbvm::Run line = made(1), plane = made(2);
      ASSERT_EQ(line.q.size(), 3u);
      EXPECT_EQ(line.q_names, (std::vector<std::string>{"a.x", "b.x", "c.x"}));
      const double tolerance = std::string(precision) == "double" ? 1e-13 : 1e-15;
      for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(std::stod(line.q[i]), std::stod(plane.q[2 * i]), tolerance) << precision << ' ' << method;
        EXPECT_NEAR(std::stod(line.output_p[i]), std::stod(plane.output_p[2 * i]), 4 * tolerance);
      }
    }
}

/// The reference of the line, in thirty digits, is that of the plane.
TEST(OneDimension, HasReferences) {
  const auto made = [&](int dimension) {
    return reference({.scene = on_a_line(dimension), .times = {1}, .digits = 30}).times.at(0);
  };
  const auto line = made(1), plane = made(2);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(line.q[i].substr(0, 30), plane.q[2 * i].substr(0, 30));
}

TEST(OneDimension, IsDescribedAndDrawn) {
  const SceneFacts facts = describe(on_a_line(1));
  EXPECT_EQ(facts.degrees_of_freedom, 2);
  EXPECT_TRUE(facts.momenta.empty() || facts.momenta[0].name == "P_x");
  const hbvm::Run drawn = run({.scene = on_a_line(1), .step = "1/16", .until = 2, .picture = true});
  ASSERT_TRUE(drawn.figure);
  EXPECT_EQ(drawn.figure->panels.at(0).curves.size(), 3u);
  EXPECT_EQ(drawn.figure->panels.at(0).y.label, "x");
}

/// A body that a formula holds on the line is drawn without a surface.
TEST(OneDimension, DrawsABodyThatIsHeld) {
  Scene scene(1, "held");
  scene.body({.name = "a", .position = {1}}).body({.name = "b", .position = {2}, .velocity = {1}});
  scene.constraint({.kind = "formula", .names = {{"on", {"a"}}}, .g = "x^2 - 1"});
  const hbvm::Run drawn = run({.scene = scene, .step = "1/16", .until = 1, .picture = true});
  EXPECT_EQ(drawn.figure->panels.at(0).curves.size(), 2u);
}

TEST(OneDimension, HasNoTurning) {
  Scene scene = on_a_line(1);
  scene.observe("angle", "angle(a, b)");
  EXPECT_THROW(run({.scene = scene, .step = "1/4", .until = 1}), InputError);
}

}  // namespace
}  // namespace hbvm
