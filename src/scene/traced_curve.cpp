#include "scene/traced_curve.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <optional>

#include "scalar/scalar.hpp"

namespace hbvm::core {
namespace {

class CurveTracer {
 public:
  CurveTracer(const std::vector<LevelFunction>& g, const SpaceBox& box, int dimension)
      : g_(g), box_(box), d_(dimension), step_(box.longest() / 200), least_step_(step_ / 20), small_(step_ / 1000) {}

  PointLine traced(const std::array<double, 3>& start) const {
    Vector<double> first(d_);
    for (Index i = 0; i < d_; ++i) first[i] = start[static_cast<std::size_t>(i)];
    const std::optional<Vector<double>> at = on_curve(first);
    if (!at) return {};
    PointLine line;
    if (!follow(*at, 1, line)) {
      std::reverse(line.begin(), line.end());
      if (!line.empty()) line.pop_back();
      follow(*at, -1, line);
    }
    return line;
  }

 private:
  static constexpr std::size_t most_points = 2000;
  static constexpr double straight = 49 / double{50};  // the cosine of an angle that is not seen

  /// Adds points from the first on; true if the line comes back to it.
  bool follow(const Vector<double>& first, double sense, PointLine& line) const {
    Vector<double> at = first, before = sense * tangent(first);
    const auto add = [&](const Vector<double>& x) {
      std::array<double, 3> point{};
      for (Index i = 0; i < d_; ++i) point[static_cast<std::size_t>(i)] = x[i];
      line.push_back(point);
    };
    add(at);
    bool was_away = false;
    for (std::size_t n = 0; n < most_points; ++n) {
      Vector<double> along = tangent(at);
      if (!along.allFinite()) return false;
      if (along.dot(before) < 0) along = -along;
      std::optional<Vector<double>> next;
      // Where the curve bends much it is followed in smaller steps, and at a corner in the smallest.
      for (double step = step_; !next && step > least_step_; step /= 2) {
        next = on_curve(at + step * along);
        if (!next) continue;
        const bool bends = step > 2 * least_step_ && !(std::abs(tangent(*next).dot(along)) > straight);
        if (bends || (*next - at).norm() > 2 * step || (*next - at).dot(along) <= 0) next.reset();
      }
      if (!next || !is_inside(*next)) return false;
      before = along;
      at = *next;
      add(at);
      const double from_first = (at - first).norm();
      was_away = was_away || from_first > 2 * step_;
      if (was_away && from_first < step_) {
        line.push_back(line.front());
        return true;
      }
    }
    return false;
  }

  bool is_inside(const Vector<double>& x) const {
    for (Index i = 0; i < d_; ++i)
      if (x[i] < box_.low[static_cast<std::size_t>(i)] || x[i] > box_.high[static_cast<std::size_t>(i)]) return false;
    return true;
  }

  Vector<double> values(const Vector<double>& x) const {
    Vector<double> result(static_cast<Index>(g_.size()));
    const Matrix<double> point = x.transpose();
    for (std::size_t i = 0; i < g_.size(); ++i) result[static_cast<Index>(i)] = g_[i](point)[0];
    return result;
  }

  /// By differences: a row for each function.
  Matrix<double> jacobian(const Vector<double>& x) const {
    Matrix<double> points(2 * d_, d_);
    for (Index j = 0; j < d_; ++j)
      for (const int sense : {-1, 1}) {
        const Index row = 2 * j + (sense + 1) / 2;
        points.row(row) = x.transpose();
        points(row, j) += sense * small_;
      }
    Matrix<double> result(static_cast<Index>(g_.size()), d_);
    for (std::size_t i = 0; i < g_.size(); ++i) {
      const Vector<double> at = g_[i](points);
      for (Index j = 0; j < d_; ++j) result(static_cast<Index>(i), j) = (at[2 * j + 1] - at[2 * j]) / (2 * small_);
    }
    return result;
  }

  /// Of length 1, across all gradients.
  Vector<double> tangent(const Vector<double>& x) const {
    const Matrix<double> J = jacobian(x);
    Vector<double> along(d_);
    if (d_ == 2)
      along << -J(0, 1), J(0, 0);
    else
      along << J(0, 1) * J(1, 2) - J(0, 2) * J(1, 1), J(0, 2) * J(1, 0) - J(0, 0) * J(1, 2),
          J(0, 0) * J(1, 1) - J(0, 1) * J(1, 0);
    return along / along.norm();
  }

  /// The next point of the curve.
  std::optional<Vector<double>> on_curve(Vector<double> x) const {
    constexpr int most_iterations = 8;
    for (int n = 0; n < most_iterations; ++n) {
      const Vector<double> g = values(x);
      const Matrix<double> J = jacobian(x);
      if (!g.allFinite() || !J.allFinite()) return std::nullopt;
      const Vector<double> change = J.completeOrthogonalDecomposition().solve(g);
      x -= change;
      if (!x.allFinite()) return std::nullopt;
      if (change.norm() <= small_ * small_ / step_) return x;
    }
    return std::nullopt;
  }

  const std::vector<LevelFunction>& g_;
  const SpaceBox& box_;
  Index d_;
  double step_, least_step_, small_;
};

}  // namespace

PointLine traced_curve(const std::vector<LevelFunction>& g, const std::array<double, 3>& start, const SpaceBox& box,
                       int dimension) {
  return CurveTracer(g, box, dimension).traced(start);
}

}  // namespace hbvm::core
