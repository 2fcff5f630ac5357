#include "scene/sketch.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>

#include "scene/assemble.hpp"
#include "scene/held_on.hpp"

namespace hbvm::core {
namespace {

std::size_t place_of(const Sketch& sketch, const std::string& name) {
  for (std::size_t i = 0; i < sketch.places.size(); ++i)
    if (sketch.places[i].name == name) return i;
  ADD_FAILURE() << "no place '" << name << "'";
  return 0;
}

std::vector<double> start_of(const Scene& scene) {
  const Vector<double> q = assemble<double>(scene).q0;
  return {q.begin(), q.end()};
}

TEST(Sketch, ShowsBodiesPointsAndRods) {
  const Scene scene = load_scene("double_pendulum");
  const Sketch found = sketch(scene);
  const std::vector<double> q = start_of(scene);
  const std::size_t a = place_of(found, "a"), b = place_of(found, "b"), pivot = place_of(found, "pivot");
  EXPECT_EQ(found.position(b, q), (std::array{q[2], q[3], 0.0}));
  EXPECT_TRUE(found.places[a].has_mass);
  EXPECT_FALSE(found.places[pivot].has_mass);
  EXPECT_TRUE(found.places[pivot].at.blocks.empty());
  ASSERT_EQ(found.links.size(), 2u);
  EXPECT_EQ(found.links[0].a, pivot);
  EXPECT_EQ(found.links[0].b, a);
  EXPECT_EQ(found.links[1].a, a);
  EXPECT_EQ(found.links[1].b, b);
  EXPECT_EQ(found.links[1].as, Sketch::Joins::rod);
}

TEST(Sketch, ShowsChargesAndSprings) {
  const Sketch charged = sketch(load_scene("modified_pendulum"));
  EXPECT_TRUE(std::any_of(charged.places.begin(), charged.places.end(), [](const auto& p) { return p.charge != 0; }));
  const Sketch sprung = sketch(load_scene("spring_and_plane"));
  EXPECT_TRUE(std::any_of(sprung.links.begin(), sprung.links.end(),
                          [](const auto& l) { return l.as == Sketch::Joins::spring; }));
}

/// Where the mass centre is by the rotation of the body, not by its directors' coordinates.
TEST(Sketch, ShowsTheMassCentreOfARigidBody) {
  for (const bool fixed : {true, false}) {
    Scene scene = load_scene("heavy_top");
    scene.rigid_bodies.front().fixed = fixed;
    for (const char* const x : {"5", "-7", "11"}) scene.rigid_bodies.front().velocity.push_back(Expression::parse(x));
    if (fixed) scene.rigid_bodies.front().velocity.clear();
    scene.rigid_bodies.front().position = {Expression::parse("2"), Expression::parse("3"), Expression::parse("4")};
    const Sketch found = sketch(scene);
    const std::vector<double> q = start_of(scene);
    const std::array<double, 3> at = found.position(place_of(found, "top"), q);
    // center = (1/10, -1/20, 1), directors (3, -6, 2)/7, (6, 2, -3)/7, (2, 3, 6)/7.
    const double expected[] = {2 + (0.3 - 0.3 + 2) / 7, 3 + (-0.6 - 0.1 + 3) / 7, 4 + (0.2 + 0.15 + 6) / 7};
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(at[i], expected[i], 1e-14) << i << fixed;
    EXPECT_TRUE(found.places[place_of(found, "top")].labelled);
    ASSERT_EQ(found.bodies.size(), 1u);
    // The corners are about the centre of mass, in the frame of the directors.
    const std::vector<std::array<double, 3>> corners = found.corners(found.bodies.front(), q);
    const Solid& solid = found.bodies.front().solid;
    for (std::size_t n = 0; n < corners.size(); ++n)
      for (std::size_t i = 0; i < 3; ++i) {
        const double directors[3][3] = {{3, -6, 2}, {6, 2, -3}, {2, 3, 6}};
        double x = 2 + static_cast<double>(i);
        for (std::size_t a = 0; a < 3; ++a) x += solid.corners[n][a] * directors[a][i] / 7;
        EXPECT_NEAR(corners[n][i], x, 1e-14);
      }
    if (!fixed) continue;
    EXPECT_EQ(found.position(place_of(found, "top.reference"), q), (std::array{2.0, 3.0, 4.0}));
    EXPECT_FALSE(found.places[place_of(found, "top.reference")].labelled);
  }
}

std::vector<Sketch::Link> links_as(const Sketch& sketch, Sketch::Joins as) {
  std::vector<Sketch::Link> result;
  for (const Sketch::Link& link : sketch.links)
    if (link.as == as) result.push_back(link);
  return result;
}

/// A bar that begins where the other ends: both attachments of the joint are at one place. The lower one, fastened at
/// one point, is the box of its moment of inertia.
TEST(Sketch, ShowsAttachmentsOfRigidBodies) {
  const Scene scene = load_scene("double_physical_pendulum");
  const Sketch found = sketch(scene);
  const std::vector<double> q = start_of(scene);
  ASSERT_EQ(scene.attachments.size(), 2u);
  const std::array<double, 3> end = found.position(place_of(found, scene.attachments[0].name), q),
                              begin = found.position(place_of(found, scene.attachments[1].name), q);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(end[i], begin[i], 1e-15);
  EXPECT_NEAR(end[0], 0.6, 1e-15);
  EXPECT_NEAR(end[1], -0.8, 1e-15);
  for (const SceneAttachment& attachment : scene.attachments)
    EXPECT_EQ(found.places[place_of(found, attachment.name)].mark, Sketch::Place::Mark::joint);
  const std::vector<Sketch::Link> bars = links_as(found, Sketch::Joins::body);
  ASSERT_EQ(bars.size(), 1u);
  EXPECT_EQ(std::set({bars[0].a, bars[0].b}),
            std::set({place_of(found, "upper.reference"), place_of(found, scene.attachments[0].name)}));
  ASSERT_EQ(found.bodies.size(), 1u);
  EXPECT_EQ(found.bodies[0].place, place_of(found, "lower"));
  EXPECT_NEAR(found.bodies[0].solid.radius(), std::hypot(0.4, 0.05), 1e-12) << "4/5 long and 1/10 wide";
}

/// Two bars between joints, and a plate through its three points.
TEST(Sketch, LeadsBarsFromJointToJoint) {
  const Scene scene = load_scene("four_bar_linkage_of_bars");
  const Sketch found = sketch(scene);
  const std::vector<double> q = start_of(scene);
  const std::vector<Sketch::Link> bars = links_as(found, Sketch::Joins::body);
  ASSERT_EQ(bars.size(), 2u);
  for (const auto& [bar, length] : {std::pair(bars[0], 1.0), std::pair(bars[1], 2.5)}) {
    const std::array<double, 3> a = found.position(bar.a, q), b = found.position(bar.b, q);
    EXPECT_NEAR(std::hypot(a[0] - b[0], a[1] - b[1]), length, 1e-14);
    for (const std::size_t end : {bar.a, bar.b})
      EXPECT_TRUE(found.places[end].at.blocks.empty() || found.places[end].mark == Sketch::Place::Mark::joint);
  }
  ASSERT_EQ(found.bodies.size(), 1u);
  const std::vector<std::array<double, 3>> plate = found.corners(found.bodies[0], q);
  ASSERT_EQ(plate.size(), 3u);
  for (const std::array<double, 2>& point : {std::array{0.0, 0.0}, {3.0, 0.0}, {1.5, 0.75}}) {
    const double x = -0.8 + 0.8 * point[0] - 0.6 * point[1], y = 0.6 + 0.6 * point[0] + 0.8 * point[1];
    EXPECT_TRUE(std::any_of(plate.begin(), plate.end(), [&](const auto& corner) {
      return std::hypot(corner[0] - x, corner[1] - y) < 1e-14;
    })) << point[0];
  }
}

/// Rings by their shape, and lines along the axes of the hinges that turn with the first body.
TEST(Sketch, ShowsHingesAndShapes) {
  const Scene scene = load_scene("gyroscope_on_gimbal");
  const Sketch found = sketch(scene);
  const std::vector<double> q = start_of(scene);
  ASSERT_EQ(found.bodies.size(), 3u);
  EXPECT_FALSE(found.bodies[0].solid.closed);
  EXPECT_NEAR(found.bodies[1].solid.radius(), std::hypot(0.4, 0.4 / 12), 1e-12);
  EXPECT_NEAR(found.bodies[2].solid.radius(), std::hypot(0.3, 0.05), 1e-12) << "a disc by its inertia";
  const std::vector<Sketch::Link> axes = links_as(found, Sketch::Joins::axis);
  ASSERT_EQ(axes.size(), 3u);
  const double directions[3][3] = {{0, 0, 1}, {3.0 / 5, 4.0 / 5, 0}, {12.0 / 25, -9.0 / 25, 4.0 / 5}};
  for (std::size_t n = 0; n < 3; ++n) {
    const std::array<double, 3> a = found.position(axes[n].a, q), b = found.position(axes[n].b, q);
    const double length = std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
    EXPECT_GT(length, 0.2);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR((b[i] - a[i]) / length, directions[n][i], 1e-14) << n;
    EXPECT_FALSE(found.places[axes[n].a].labelled);
  }
}

/// What is fastened outside of a body is joined to its centre of mass.
TEST(Sketch, JoinsABodyToWhatIsFastenedOutside) {
  const std::string text = R"(dimension = 2
[[rigid_body]]
name = "bob"
fixed_at = [0, 0]
mass = 1
center = [3, 0]
inertia = "1/2"
orientation = 0
angular_velocity = 1
)";
  const Sketch found = sketch(read_scene(text, "bob"));
  ASSERT_EQ(found.bodies.size(), 1u);
  EXPECT_NEAR(found.bodies[0].solid.radius(), 1, 1e-12);
  ASSERT_EQ(found.links.size(), 1u);
  EXPECT_EQ(std::set({found.links[0].a, found.links[0].b}),
            std::set({place_of(found, "bob"), place_of(found, "bob.reference")}));
}

/// Directors that are a left-handed frame turn no face inside out.
TEST(Sketch, KeepsFacesOutside) {
  Scene scene = load_scene("free_rigid_body");
  const auto outside = [](const Scene& shown) {
    const Sketch found = sketch(shown);
    const Solid& solid = found.bodies.front().solid;
    const std::vector<std::array<double, 3>> at = found.corners(found.bodies.front(), start_of(shown));
    double volume = 0;
    for (const auto& face : solid.faces)
      for (std::size_t i = 1; i + 1 < face.size(); ++i) {
        Eigen::Matrix3d m;
        for (Index j = 0; j < 3; ++j) {
          const auto k = static_cast<std::size_t>(j);
          m.row(j) << at[face[0]][k], at[face[i]][k], at[face[i + 1]][k];
        }
        volume += m.determinant() / 6;
      }
    return volume;
  };
  // Edges of 12 times the mean squares 1/4, 1/6, 1/8.
  EXPECT_NEAR(outside(scene), std::sqrt(3 * 2 * 1.5), 1e-12);
  for (Expression& x : scene.rigid_bodies.front().directors[2]) x = Expression::parse("-(" + x.text() + ")");
  EXPECT_NEAR(outside(scene), std::sqrt(3 * 2 * 1.5), 1e-12);
}

/// In every scene each body has its place, and each rigid one is a solid or a bar.
TEST(Sketch, LeavesNoBodyOut) {
  for (const auto& [name, text] : built_in_scenes()) {
    const Scene scene = load_scene(name);
    const Sketch found = sketch(scene);
    for (const SceneBody& body : scene.bodies) EXPECT_TRUE(found.places[place_of(found, body.name)].has_mass) << name;
    for (const SceneRigidBody& body : scene.rigid_bodies) {
      const std::size_t place = place_of(found, body.name);
      EXPECT_TRUE(found.places[place].has_mass) << name;
      const bool solid = std::any_of(found.bodies.begin(), found.bodies.end(),
                                     [&](const Sketch::Body& drawn) { return drawn.place == place; });
      const bool bar = std::any_of(found.links.begin(), found.links.end(), [&](const Sketch::Link& link) {
        return link.as == Sketch::Joins::body && found.places[link.a].of == place && found.places[link.b].of == place;
      });
      EXPECT_TRUE(solid || bar) << body.name << " of " << name;
    }
    EXPECT_EQ(found.held_on.empty(), scene.bodies.empty() || holding(scene, scene.bodies.front()).empty()) << name;
  }
}

}  // namespace
}  // namespace hbvm::core
