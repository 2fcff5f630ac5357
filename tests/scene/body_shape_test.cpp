#include "scene/body_shape.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hbvm::core {
namespace {

Expression expression(double x) { return Expression::parse(std::to_string(x)); }

SceneVector expressions_of(const std::vector<double>& x) {
  SceneVector result;
  for (const double one : x) result.push_back(expression(one));
  return result;
}

SceneRigidBody shaped_body(double mass, const std::vector<double>& center, const std::vector<std::vector<double>>& S) {
  SceneMatrix second_moment;
  for (const auto& row : S) second_moment.push_back(expressions_of(row));
  return {"body", false, {}, {}, expression(mass), expressions_of(center), second_moment, {}, {}};
}

using Points = std::vector<Solid::Point>;

/// S of a homogeneous box with these half edges (vectors) about its middle c: m (c c^T + sum h h^T/3).
std::vector<std::vector<double>> moment_of(double mass, const std::vector<double>& c, const Points& halves) {
  const std::size_t d = c.size();
  std::vector<std::vector<double>> S(d, std::vector<double>(d));
  for (std::size_t i = 0; i < d; ++i)
    for (std::size_t j = 0; j < d; ++j) {
      S[i][j] = mass * c[i] * c[j];
      for (const Solid::Point& h : halves) S[i][j] += mass * h[i] * h[j] / 3;
    }
  return S;
}

bool has_corner(const Solid& solid, const Solid::Point& at, double tolerance) {
  return std::any_of(solid.corners.begin(), solid.corners.end(), [&](const Solid::Point& c) {
    return std::hypot(c[0] - at[0], c[1] - at[1], c[2] - at[2]) < tolerance;
  });
}

/// A box of known edges, turned and away from the reference point, is found back from its second moment to its corners.
TEST(BodyShape, IsTheBoxThatHasTheMoments) {
  const Points halves{{2.0 / 3, 2.0 / 3, 1.0 / 3}, {-1, 0.5, 1}, {0.1 * 1.0 / 3, -0.1 * 2.0 / 3, 0.1 * 2.0 / 3}};
  const std::vector<double> c{0.5, -0.25, 2};
  const Solid box = body_shape(shaped_body(3, c, moment_of(3, c, halves)), {}, 0);
  ASSERT_EQ(box.corners.size(), 8u);
  for (const double x : {-1, 1})
    for (const double y : {-1, 1})
      for (const double z : {-1, 1}) {
        Solid::Point corner{};
        for (std::size_t i = 0; i < 3; ++i) corner[i] = c[i] + x * halves[0][i] + y * halves[1][i] + z * halves[2][i];
        EXPECT_TRUE(has_corner(box, corner, 1e-4)) << x << y << z;  // moments of six decimals
      }
  const Solid::Point edges = edges_of_box({4.0 / 12, 9.0 / 12, 25.0 / 12});
  EXPECT_NEAR(edges[0], 2, 1e-15);
  EXPECT_NEAR(edges[1], 3, 1e-15);
  EXPECT_NEAR(edges[2], 5, 1e-15);
}

/// A cylinder has m R^2/4 across its axis and m L^2/12 along.
TEST(BodyShape, IsACylinderIfTwoMomentsAreEqual) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const auto& [radius, length] : {std::pair(2.0, 1.0), std::pair(0.5, 6.0)}) {
      std::vector<std::vector<double>> S(3, std::vector<double>(3, 0));
      for (std::size_t i = 0; i < 3; ++i) S[i][i] = 4 * (i == axis ? length * length / 12 : radius * radius / 4);
      const Solid solid = body_shape(shaped_body(4, {0, 0, 0}, S), {}, 0);
      ASSERT_EQ(solid.corners.size(), 72u);
      for (const Solid::Point& corner : solid.corners) {
        EXPECT_NEAR(std::abs(corner[axis]), length / 2, 1e-4);
        EXPECT_NEAR(std::hypot(corner[(axis + 1) % 3], corner[(axis + 2) % 3]), radius, 1e-4);
      }
    }
  EXPECT_EQ(body_shape(shaped_body(1, {0, 0, 0}, {{2, 0, 0}, {0, 2, 0}, {0, 0, 2}}), {}, 0).corners.size(), 8u);
}

TEST(BodyShape, IsFlatInThePlane) {
  // A bar of length 4 along (3/5, 4/5), 1 wide.
  const Points halves{{1.2, 1.6, 0}, {-0.4, 0.3, 0}};
  const Solid bar = body_shape(shaped_body(2, {1, 0}, moment_of(2, {1, 0}, halves)), {}, 0);
  ASSERT_EQ(bar.corners.size(), 4u);
  for (const double x : {-1, 1})
    for (const double y : {-1, 1})
      EXPECT_TRUE(has_corner(bar, {1 + x * 1.2 - y * 0.4, x * 1.6 + y * 0.3, 0}, 1e-4)) << x << y;
  // A disc has the moment of inertia m R^2/2; a matrix that no body has, but with its trace, is one as well.
  for (const std::vector<std::vector<double>>& S :
       {std::vector<std::vector<double>>{{4.5, 0}, {0, 4.5}}, {{10, 0}, {0, -1}}}) {
    const Solid disc = body_shape(shaped_body(2, {0, 0}, S), {}, 0);
    for (const Solid::Point& corner : disc.corners) EXPECT_NEAR(std::hypot(corner[0], corner[1]), 3, 1e-6);
  }
}

/// A sheet and a needle are drawn with some thickness, a point mass as something.
TEST(BodyShape, IsNeverWithoutThickness) {
  for (const std::vector<double>& squares : {std::vector<double>{1, 2, 0}, {0, 0, 3}, {1, 1, 0}, {0, 1, 0}}) {
    std::vector<std::vector<double>> S(3, std::vector<double>(3, 0));
    for (std::size_t i = 0; i < 3; ++i) S[i][i] = squares[i];
    const Solid solid = body_shape(shaped_body(1, {0, 0, 0}, S), {}, 0);
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [low, high] = std::minmax_element(solid.corners.begin(), solid.corners.end(),
                                                   [&](const auto& a, const auto& b) { return a[i] < b[i]; });
      EXPECT_GT((*high)[i] - (*low)[i], solid.radius() / 25);
    }
  }
}

TEST(BodyShape, OfMuchTooLargeABodyIsFitted) {
  const SceneRigidBody body = shaped_body(1, {1, 0, 0}, {{1001, 0, 0}, {0, 2000, 0}, {0, 0, 3000}});
  EXPECT_NEAR(body_shape(body, {}, 1).radius(), 0.5, 1e-12);
  EXPECT_NEAR(body_shape(body, {}, 1).centre()[0], 1, 1e-12);
  EXPECT_NEAR(body_shape(body, {}, 0).radius(), std::sqrt(12 * 6000.0) / 2, 1e-9) << "of a body alone nothing is";
  EXPECT_NEAR(body_shape(body, {}, 100).radius(), std::sqrt(12 * 6000.0) / 2, 1e-9);
}

TEST(BodyShape, IsTheShapeThatIsGiven) {
  SceneRigidBody body = shaped_body(1, {0, 0, 1}, {{1, 0, 0}, {0, 2, 0}, {0, 0, 4}});
  body.shape = SceneShape{"cylinder", expressions_of({0.5, 3}), expressions_of({2, 0, 0}), {}};
  const Constants none;
  for (const Solid::Point& corner : body_shape(body, none, 0).corners) {
    EXPECT_NEAR(std::abs(corner[0]), 1.5, 1e-12);
    EXPECT_NEAR(std::hypot(corner[1], corner[2] - 1), 0.5, 1e-12) << "about the centre of mass";
  }
  body.shape = SceneShape{"box", expressions_of({1, 2, 3}), {}, expressions_of({5, 0, 0})};
  EXPECT_TRUE(has_corner(body_shape(body, none, 0), {5.5, -1, 1.5}, 1e-12));
  body.shape = SceneShape{"sphere", expressions_of({2}), {}, {}};
  EXPECT_NEAR(body_shape(body, none, 0).radius(), 2, 1e-12);
  // A constant that was changed has made it nothing.
  body.shape = SceneShape{"sphere", expressions_of({-2}), {}, {}};
  EXPECT_EQ(body_shape(body, none, 0).corners.size(), 8u);
}

}  // namespace
}  // namespace hbvm::core
