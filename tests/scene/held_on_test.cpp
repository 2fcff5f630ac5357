#include "scene/held_on.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "problem/constraint.hpp"
#include "scene/assemble.hpp"

namespace hbvm::core {
namespace {

std::vector<double> q_of(const Scene& scene) {
  const Vector<double> q = assemble<double>(scene).q0;
  return {q.begin(), q.end()};
}

/// The functions are those of the problem that is solved, to the last digits.
TEST(HeldOn, IsWhatTheProblemHas) {
  for (const char* const name : {"bead_on_torus", "bead_on_quartic", "bead_on_ellipsoid", "bead_on_paraboloid",
                                 "bead_on_helix", "bead_on_cycloid", "spring_and_plane"}) {
    const Scene scene = load_scene(name);
    const Problem<double> problem = assemble<double>(scene).problem;
    const std::vector<LevelFunction> g = holding(scene, scene.bodies.front());
    ASSERT_EQ(g.size(), problem.constraints.size()) << name;
    Matrix<double> points(2, 3);
    points << 0.3, -0.2, 0.5, 0.7, 0.4, -0.6;
    for (std::size_t i = 0; i < g.size(); ++i) {
      const Vector<double> found = g[i](points);
      for (Index n = 0; n < 2; ++n) {
        Vector<double> q = Vector<double>::Zero(problem.m());
        q.head(3) = points.row(n).transpose();
        EXPECT_NEAR(found[n], value(problem.constraints[i], 3, q).g, 1e-14) << name << i << n;
      }
    }
  }
  EXPECT_TRUE(holding(load_scene("spring_and_plane"), load_scene("spring_and_plane").bodies[1]).empty());
}

/// Of the torus of the radii 2 and 1 that a geodesic goes around on.
TEST(HeldOn, IsAMeshOfASurface) {
  const Scene scene = load_scene("bead_on_torus");
  const std::vector<PointLine> lines =
      held_on(scene, {{3, 0, 0}, {-3, 0, 0}, {0, 3, 0}, {0, -3, 0}, {2, 0, 1}, {2, 0, -1}}).meshes;
  EXPECT_GT(lines.size(), 30u);
  for (const PointLine& line : lines)
    for (const auto& [x, y, z] : line) {
      const double r = std::hypot(x, y) - 2;
      // The last part of an edge is below 7.5/32/64 long; the second derivatives of g are up to 2 outside of r = 1.
      if (std::hypot(x, y) > 1) {
        EXPECT_NEAR(r * r + z * z, 1, 2 * 0.0037 * 0.0037 / 8);
      }
    }
}

TEST(HeldOn, IsALineIfItIsACurve) {
  const Scene helix = load_scene("bead_on_helix"), curves = load_scene("rod_on_two_curves");
  const std::vector<PointLine> line = held_on(helix, {q_of(helix), {-1, 0, M_PI}}).curves;
  ASSERT_EQ(line.size(), 1u);
  for (const auto& [x, y, z] : line.front()) EXPECT_NEAR(x, std::cos(z), 1e-8);
  const std::vector<PointLine> two = held_on(curves, {q_of(curves), {1, std::sin(1), -0.5, 2}}).curves;
  ASSERT_EQ(two.size(), 2u);
  double farthest = 0;
  for (const PointLine& each : two)
    for (const auto& [x, y, z] : each)
      farthest = std::max(farthest, std::min(std::abs(y - std::sin(x)), std::abs(y - 1 - std::cosh(x))));
  EXPECT_LT(farthest, 1e-8);
}

/// Bodies that the same formula holds have one mesh, over all their places.
TEST(HeldOn, IsThereOnceForBodiesHeldAlike) {
  const auto scene_with = [](const std::string& second) {
    return read_scene(
        "dimension = 3\nbody = [{ name = \"a\", mass = 1, position = [1, 0, 0], velocity = [0, 0, 0] },"
        "{ name = \"b\", mass = 1, position = [0, 1, 0], velocity = [0, 0, 0] }]\n"
        "[[constraint]]\nkind = \"formula\"\non = \"a\"\ng = \"x^2 + y^2 + z^2 - 1\"\n"
        "[[constraint]]\nkind = \"formula\"\non = \"b\"\ng = \"" +
            second + "\"\n",
        "two");
  };
  const Scene alike = scene_with("x^2 + y^2 + z^2 - 1"), apart = scene_with("x^2 + y^2 + z^4 - 1");
  const std::vector<std::vector<double>> states{{1, 0, 0, 0, 1, 0}, {0, 0, 1, -1, 0, 0}};
  EXPECT_LT(held_on(alike, states).meshes.size(), held_on(apart, states).meshes.size());
  EXPECT_FALSE(held_on(alike, {states.front()}).empty());
}

/// Without such a constraint there is nothing, and of a start alone something.
TEST(HeldOn, IsNothingWithoutAConstraintOfABodyAlone) {
  for (const char* const name : {"double_pendulum", "scissors", "rope_over_two_pegs", "gyroscope_on_gimbal", "kepler"})
    EXPECT_TRUE(held_on(load_scene(name), {q_of(load_scene(name))}).empty()) << name;
  for (const char* const name : {"bead_on_torus", "bead_on_quartic", "bead_on_ellipsoid", "bead_on_paraboloid",
                                 "bead_on_helix", "bead_on_cycloid", "spring_and_plane", "rod_on_two_curves"})
    EXPECT_FALSE(held_on(load_scene(name), {q_of(load_scene(name))}).empty()) << name;
}

}  // namespace
}  // namespace hbvm::core
