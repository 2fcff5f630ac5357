#include "scene/sketch.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "scene/assemble.hpp"

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
    EXPECT_EQ(found.position(place_of(found, "top.reference"), q), (std::array{2.0, 3.0, 4.0}));
    EXPECT_EQ(found.links.size(), 4u);
    EXPECT_TRUE(found.places[place_of(found, "top")].labelled);
    EXPECT_FALSE(found.places[place_of(found, "top.reference")].labelled);
  }
}

/// A bar that begins where the other ends: both attachments of the joint are at one place.
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
  EXPECT_EQ(found.links.size(), 4u) << "to the mass centre and the attachment of each";
}

}  // namespace
}  // namespace hbvm::core
