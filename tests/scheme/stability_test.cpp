#include "scheme/stability.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace hbvm::core {
namespace {

struct Table {
  Eigen::MatrixXd A;
  Eigen::VectorXd b;
  double angle() const { return LinearStability(A, b).angle(); }
  double ssp() const { return ssp_coefficient(A, b); }
  bool is_algebraic() const { return is_algebraically_stable(A, b); }
};

Table table(std::initializer_list<double> a, std::initializer_list<double> weights) {
  const auto s = static_cast<Eigen::Index>(weights.size());
  Table result{Eigen::MatrixXd(s, s), Eigen::VectorXd(s)};
  Eigen::Index n = 0;
  for (const double x : a) {
    result.A(n / s, n % s) = x;
    ++n;
  }
  n = 0;
  for (const double x : weights) result.b[n++] = x;
  return result;
}

const double root3 = std::sqrt(3.0);
const Table euler = table({0}, {1}), backward_euler = table({1}, {1}), trapezoid = table({0, 0, 0.5, 0.5}, {0.5, 0.5}),
            gauss2 = table({0.25, 0.25 - root3 / 6, 0.25 + root3 / 6, 0.25}, {0.5, 0.5}),
            radau2 = table({5 / 12.0, -1 / 12.0, 0.75, 0.25}, {0.75, 0.25}),
            shu_osher = table({0, 0, 0, 1, 0, 0, 0.25, 0.25, 0}, {1 / 6.0, 1 / 6.0, 2 / 3.0}),
            rk4 = table({0, 0, 0, 0, 0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 1, 0}, {1 / 6.0, 1 / 3.0, 1 / 3.0, 1 / 6.0});

TEST(SchemeStability, SeesAStability) {
  for (const Table& t : {backward_euler, trapezoid, gauss2, radau2}) EXPECT_EQ(t.angle(), 90);
  for (const Table& t : {euler, rk4}) EXPECT_EQ(t.angle(), 0);
  // |R| = 1 on the axis, but with a pole on the left: R(z) = (1 - z)/(1 + z) of a step back.
  EXPECT_EQ(table({-0.5}, {-1}).angle(), 0);
}

/// A step of the adjoint method is one back by the method itself, 1 b^T - A: R(z) is 1/R(-z).
Table adjoint(const Table& t) {
  const auto s = t.b.size();
  return {Eigen::VectorXd::Ones(s) * t.b.transpose() - t.A, t.b};
}

/// The values of 1/(1 - z + z^2/2 - ...), of three terms and of four, were found by a scan in another language.
TEST(SchemeStability, MeasuresASector) {
  EXPECT_EQ(adjoint(euler).angle(), 90);
  EXPECT_NEAR(adjoint(shu_osher).angle(), 88.230, 0.02);
  EXPECT_NEAR(adjoint(rk4).angle(), 83.984, 0.02);
  // With g = 1/5 on the diagonal R(inf) = (1/2 - 2 g + g^2)/g^2.
  const Table growing = table({0.2, 0, 0.6, 0.2}, {0.5, 0.5});
  EXPECT_NEAR(*LinearStability(growing.A, growing.b).at_infinity(), 3.5, 1e-12);
  EXPECT_EQ(growing.angle(), 0);
  EXPECT_EQ(table({0.25, 0, 0.5, 0.25}, {0.5, 0.5}).angle(), 90);
}

TEST(SchemeStability, SeesAlgebraicStability) {
  for (const Table& t : {backward_euler, gauss2, radau2}) EXPECT_TRUE(t.is_algebraic());
  for (const Table& t : {euler, trapezoid, rk4}) EXPECT_FALSE(t.is_algebraic());
}

/// Known radii: 1 of Euler and of Shu and Osher's method, 2 of the trapezoidal rule, none of RK4 and Gauss.
TEST(SchemeStability, FindsRadiiOfMonotonicity) {
  EXPECT_NEAR(euler.ssp(), 1, 1e-6);
  EXPECT_NEAR(shu_osher.ssp(), 1, 1e-6);
  EXPECT_NEAR(trapezoid.ssp(), 2, 1e-6);
  EXPECT_EQ(backward_euler.ssp(), std::numeric_limits<double>::infinity());
  EXPECT_EQ(rk4.ssp(), 0);
  EXPECT_EQ(gauss2.ssp(), 0);
}

}  // namespace
}  // namespace hbvm::core
