#include "scene/level_lines.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace hbvm::core {
namespace {

LevelFunction each(const std::function<double(double, double, double)>& g) {
  return [g](const Matrix<double>& points) -> Vector<double> {
    Vector<double> result(points.rows());
    for (Index i = 0; i < points.rows(); ++i) result[i] = g(points(i, 0), points(i, 1), points(i, 2));
    return result;
  };
}

const SpaceBox about_origin{{-2, -2, -2}, {2, 2, 2}};
constexpr double cell = 4.0 / level_cells, last = cell / (1 << level_halvings);

/// On the last part h of an edge g is off its chord by up to h^2/8 max |g''|.
TEST(LevelLines, AreWhereTheFunctionVanishes) {
  const auto sphere = [](double x, double y, double z) { return x * x + y * y + z * z - 2.25; };
  const std::vector<PointLine> lines = level_lines(each(sphere), about_origin);
  // Planes of distance 1/3: nine of each direction cut the sphere, in one circle each.
  EXPECT_EQ(lines.size(), 27u);
  for (const PointLine& line : lines) {
    EXPECT_EQ(line.front(), line.back()) << "a circle is closed";
    double length = 0;
    std::size_t across = 3;
    for (std::size_t j = 0; j < 3; ++j)
      if (std::all_of(line.begin(), line.end(), [&](const auto& x) { return x[j] == line.front()[j]; })) across = j;
    ASSERT_LT(across, 3u);
    for (std::size_t n = 0; n < line.size(); ++n) {
      EXPECT_LE(std::abs(sphere(line[n][0], line[n][1], line[n][2])), 2 * last * last / 8 + 1e-14);
      if (n == 0) continue;
      const double step =
          std::hypot(line[n][0] - line[n - 1][0], line[n][1] - line[n - 1][1], line[n][2] - line[n - 1][2]);
      EXPECT_LE(step, std::sqrt(2) * cell + 1e-12) << "from one edge of a cell to another";
      length += step;
    }
    const double radius = std::sqrt(2.25 - line.front()[across] * line.front()[across]);
    EXPECT_NEAR(length, 2 * M_PI * radius, 0.02);
  }
}

TEST(LevelLines, EndWhereTheBoxDoes) {
  const std::vector<PointLine> lines =
      level_lines(each([](double x, double y, double z) { return x + y / 2 + z / 3 - 0.1; }), about_origin);
  for (const PointLine& line : lines) {
    EXPECT_NE(line.front(), line.back());
    for (const auto& end : {line.front(), line.back()}) {
      const double reach = std::max({std::abs(end[0]), std::abs(end[1]), std::abs(end[2])});
      EXPECT_NEAR(reach, 2, 1e-12);
    }
  }
  EXPECT_GE(lines.size(), 30u);
}

/// A cone has a saddle on the planes beside its apex: lines do not cross.
TEST(LevelLines, GoStraightAtASaddle) {
  const std::vector<PointLine> lines =
      level_lines(each([](double x, double y, double) { return (x - 0.03) * (y - 0.04) - 0.001; }), about_origin);
  for (const PointLine& line : lines)
    for (std::size_t n = 0; n < line.size(); ++n)
      EXPECT_GE((line[n][0] - 0.03) * (line[0][0] - 0.03) + 1e-12, 0) << "it goes over to the other branch";
}

TEST(LevelLines, LeaveOutPolesAndWhatHasNoValue) {
  EXPECT_TRUE(level_lines(each([](double x, double, double) { return 1 / (x - 0.01); }), about_origin).empty());
  // Also next to a node, where g is large already.
  EXPECT_TRUE(level_lines(each([](double x, double, double) { return 1 / (x - 1e-7); }), about_origin).empty());
  for (const PointLine& line :
       level_lines(each([](double x, double y, double z) { return std::sqrt(x) - y * y - z * z; }), about_origin))
    for (const auto& point : line) EXPECT_GE(point[0], 0);
  EXPECT_TRUE(level_lines(each([](double, double, double) { return 1; }), about_origin).empty());
}

}  // namespace
}  // namespace hbvm::core
