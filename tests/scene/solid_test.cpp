#include "scene/solid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace hbvm::core {
namespace {

Solid::Point vector_product(const Solid::Point& a, const Solid::Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double scalar_product(const Solid::Point& a, const Solid::Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Solid::Point from_to(const Solid::Point& a, const Solid::Point& b) { return {b[0] - a[0], b[1] - a[1], b[2] - a[2]}; }

/// By Gauss: the sum of the tetrahedra between faces and the origin, positive where faces look outwards.
double volume(const Solid& solid) {
  double sum = 0;
  for (const auto& face : solid.faces)
    for (std::size_t i = 1; i + 1 < face.size(); ++i)
      sum +=
          scalar_product(solid.corners[face[0]], vector_product(solid.corners[face[i]], solid.corners[face[i + 1]])) /
          6;
  return sum;
}

/// Of a prism of 36 sides in place of the circle.
const double area_of_36 = 18 * std::sin(M_PI / 18);

TEST(Solid, FacesLookOutwards) {
  EXPECT_NEAR(volume(solid_box({2, 3, 5})), 30, 1e-13);
  EXPECT_NEAR(volume(solid_cylinder(2, 3)), area_of_36 * 4 * 3, 1e-13);
  EXPECT_NEAR(volume(solid_sphere(1)), 4 * M_PI / 3, 0.15);
  EXPECT_LT(volume(inside_out(solid_box({1, 1, 1}))), 0);
  for (const Solid& solid : {solid_box({2, 3, 5}), solid_cylinder(2, 3), solid_sphere(1)})
    for (const auto& face : solid.faces) {
      const Solid::Point normal = vector_product(from_to(solid.corners[face[0]], solid.corners[face[1]]),
                                                 from_to(solid.corners[face[1]], solid.corners[face[2]]));
      EXPECT_GT(scalar_product(normal, solid.corners[face[0]]), 0);
    }
}

/// What encloses a volume has V - E + F = 2, if the diameters of ends are left aside.
TEST(Solid, EdgesAreBetweenTwoFaces) {
  for (const auto& [solid, diameters] :
       {std::pair(solid_box({1, 2, 3}), 0u), {solid_cylinder(1, 1), 2u}, {solid_sphere(2), 0u}}) {
    EXPECT_EQ(solid.corners.size() + solid.faces.size(), solid.edges.size() - diameters + 2);
    EXPECT_TRUE(solid.closed);
    const auto alone = std::count_if(solid.edges.begin(), solid.edges.end(),
                                     [](const Solid::Edge& e) { return e.faces[0] == e.faces[1]; });
    EXPECT_EQ(alone, diameters);
  }
  EXPECT_FALSE(solid_ring(1).closed);
  EXPECT_FALSE(solid_disc(1).closed);
}

/// Seen along an axis a box shows one face; from a corner three, and nine of its twelve edges.
TEST(Solid, HidesWhatLooksAway) {
  const Solid box = solid_box({1, 2, 3});
  for (const auto& [seen_from, edges] : {std::pair(Solid::Point{0, 0, 1}, 4), {Solid::Point{1, 2, 3}, 9}}) {
    std::vector<bool> towards;
    for (const auto& face : box.faces)
      towards.push_back(scalar_product(vector_product(from_to(box.corners[face[0]], box.corners[face[1]]),
                                                      from_to(box.corners[face[1]], box.corners[face[2]])),
                                       seen_from) > 1e-12);
    EXPECT_EQ(std::count_if(box.edges.begin(), box.edges.end(), [&](const auto& e) { return box.shows(e, towards); }),
              edges);
  }
  // Of a cylinder seen from its side: half of both rims and two lines between them.
  const Solid cylinder = solid_cylinder(1, 2);
  std::vector<bool> towards;
  for (const auto& face : cylinder.faces) {
    const Solid::Point normal = vector_product(from_to(cylinder.corners[face[0]], cylinder.corners[face[1]]),
                                               from_to(cylinder.corners[face[1]], cylinder.corners[face[2]]));
    towards.push_back(normal[0] + normal[1] / 100 > 1e-12);
  }
  EXPECT_EQ(std::count_if(cylinder.edges.begin(), cylinder.edges.end(),
                          [&](const auto& e) { return cylinder.shows(e, towards); }),
            18 + 18 + 2);
}

TEST(Solid, HoldsWhatIsWithinIt) {
  const Solid box = placed(solid_box({2, 4, 6}), axes_about({1, 0, 0}), {10, 0, 0});
  EXPECT_TRUE(box.holds({10, 0, 0}));
  EXPECT_TRUE(box.holds({12.9, 0, 0})) << "its longest edge is along x";
  EXPECT_FALSE(box.holds({13.5, 0, 0}));
  EXPECT_FALSE(box.holds({10, 2.5, 0}));
  EXPECT_TRUE(solid_disc(1).holds({0.9, 0, 0}));
  EXPECT_FALSE(solid_disc(1).holds({1.2, 0, 0}));
  EXPECT_FALSE(solid_disc(1).holds({0, 0, 0.5}));
  EXPECT_TRUE(solid_ring(1).holds({0, 0, 0.5})) << "what is carried within a ring";
  EXPECT_FALSE(solid_ring(1).holds({0, 0, 1.5}));
}

TEST(Solid, IsPlaced) {
  for (const Solid::Point& axis : {Solid::Point{1, 2, 3}, {0, -2, 0}, {1e200, 0, -1e200}}) {
    const std::array<Solid::Point, 3> axes = axes_about(axis);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(scalar_product(axes[i], axes[i]), 1, 1e-15);
      EXPECT_NEAR(scalar_product(axes[i], axes[(i + 1) % 3]), 0, 1e-15);
      EXPECT_NEAR(scalar_product(vector_product(axes[i], axes[(i + 1) % 3]), axes[(i + 2) % 3]), 1, 1e-15);
    }
    const double size = *std::max_element(axis.begin(), axis.end());
    if (size > 0) {
      EXPECT_NEAR(axes[2][0] * axis[2] / size, axes[2][2] * axis[0] / size, 1e-15);
    }
  }
  EXPECT_LT(axes_about({0, -2, 0})[2][1], 0);
  const Solid moved = placed(solid_box({1, 1, 1}), {{{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}}}, {5, 6, 7});
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(moved.centre()[i], 5.0 + static_cast<double>(i), 1e-15);
  EXPECT_NEAR(moved.radius(), std::sqrt(3) / 2, 1e-15);
}

TEST(ConvexHull, GoesAroundPoints) {
  using Hull = std::vector<std::size_t>;
  EXPECT_EQ(convex_hull({}), Hull{});
  EXPECT_EQ(convex_hull({{1, 1, 0}, {1, 1, 0}}).size(), 1u);
  EXPECT_EQ(convex_hull({{0, 0, 0}, {3, 0, 0}, {1.5, 0.75, 0}}), (Hull{0, 1, 2}));
  EXPECT_EQ(convex_hull({{2, 2, 0}, {0, 0, 0}, {1, 1, 0}, {0, 0, 0}}).size(), 2u) << "on one line";
  // 0.1 + 0.2 is not on the line to 0.3, but for rounding it is.
  EXPECT_EQ(convex_hull({{0, 0, 0}, {0.1 + 0.2, 0.3, 0}, {0.6, 0.6, 0}}).size(), 2u);
  const Hull square = convex_hull({{1, 1, 0}, {0, 0, 0}, {0.5, 0.5, 0}, {1, 0, 0}, {0, 1, 0}});
  EXPECT_EQ(square, (Hull{1, 3, 0, 4}));
}

}  // namespace
}  // namespace hbvm::core
