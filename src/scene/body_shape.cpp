#include "scene/body_shape.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "linear/matrix.hpp"
#include "scalar/literal.hpp"

namespace hbvm::core {
namespace {

constexpr std::array<Solid::Point, 3> axes_of_frame{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

/// What is thinner than this share of its greatest length is drawn as thick.
constexpr double least_share = 1 / double{40};

class Shaper {
 public:
  Shaper(const SceneRigidBody& body, const Constants& constants)
      : body_(body), constants_(constants), d_(body.center.size()) {}

  /// A constant that was changed since may have made it nothing.
  bool has_size(const SceneShape& shape) const {
    return std::all_of(shape.sizes.begin(), shape.sizes.end(), [&](const Expression& e) { return number(e) > 0; });
  }

  Solid by_shape(const SceneShape& shape) const {
    const Solid::Point at = point(shape.at.empty() ? body_.center : shape.at);
    const std::array<Solid::Point, 3> axes = shape.axis.empty() ? axes_of_frame : axes_about(point(shape.axis));
    return placed(solid_of(shape), axes, at);
  }

  Solid by_inertia() const { return d_ == 2 ? flat() : in_space(); }

 private:
  double number(const Expression& e) const { return evaluate<double>(e, constants_); }
  Solid::Point point(const SceneVector& v) const {
    Solid::Point result{};
    for (std::size_t i = 0; i < v.size(); ++i) result[i] = number(v[i]);
    return result;
  }

  Solid solid_of(const SceneShape& shape) const {
    const double size = number(shape.sizes.front());
    if (shape.kind == "cylinder") return solid_cylinder(size, number(shape.sizes[1]));
    if (shape.kind == "disc") return solid_disc(size);
    if (shape.kind == "sphere") return solid_sphere(size);
    if (shape.kind == "ring") return d_ == 2 ? solid_disc(size) : solid_ring(size);
    return d_ == 2 ? rectangle(size, number(shape.sizes[1])) : solid_box(point(shape.sizes));
  }

  static Solid rectangle(double length, double width) {
    const double x = length / 2, y = width / 2;
    return solid_polygon({{-x, -y, 0}, {x, -y, 0}, {x, y, 0}, {-x, y, 0}});
  }

  /// The second moment about the centre of mass over the mass.
  Matrix<double> spread() const {
    const Solid::Point c = point(body_.center);
    const double mass = number(body_.mass);
    Matrix<double> result(static_cast<Index>(d_), static_cast<Index>(d_));
    for (std::size_t i = 0; i < d_; ++i)
      for (std::size_t j = 0; j < d_; ++j)
        result(static_cast<Index>(i), static_cast<Index>(j)) = number(body_.second_moment[i][j]) / mass - c[i] * c[j];
    return result;
  }

  static bool alike(double a, double b) { return std::abs(a - b) <= (std::abs(a) + std::abs(b)) / 1'000'000; }

  /// In the plane the trace alone moves anything: a matrix that no body has is spread evenly.
  Solid flat() const {
    const Matrix<double> squares = spread();
    const double trace = squares.trace();
    const Eigen::SelfAdjointEigenSolver<Matrix<double>> eigen(squares);
    const double small = eigen.eigenvalues()[0], large = eigen.eigenvalues()[1];
    const Solid::Point at = point(body_.center);
    if (alike(small, large) || small < -trace / 1'000'000)
      return placed(solid_disc(std::sqrt(2 * trace)), axes_of_frame, at);
    const Solid::Point lengths = edges_of_box({large, small, large});
    const double x = eigen.eigenvectors()(0, 1), y = eigen.eigenvectors()(1, 1);
    return placed(rectangle(lengths[0], std::max(lengths[1], least_share * lengths[0])),
                  {{{x, y, 0}, {-y, x, 0}, {0, 0, 1}}}, at);
  }

  Solid in_space() const {
    const Eigen::SelfAdjointEigenSolver<Matrix<double>> eigen(spread());
    Solid::Point squares{};
    for (std::size_t i = 0; i < 3; ++i) squares[i] = eigen.eigenvalues()[static_cast<Index>(i)];
    std::array<Solid::Point, 3> axes{};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        axes[i][j] = eigen.eigenvectors()(static_cast<Index>(j), static_cast<Index>(i));
    const Solid::Point at = point(body_.center);
    const bool lower = alike(squares[0], squares[1]), upper = alike(squares[1], squares[2]);
    if (lower && upper) return placed(solid_box(thick(edges_of_box(squares))), axes_of_frame, at);
    if (lower || upper) {
      const std::size_t along = lower ? 2 : 0, across = 1;
      const double radius = 2 * std::sqrt(std::max(squares[across], double{0})), length = edges_of_box(squares)[along],
                   least = least_share * std::max(2 * radius, length);
      return placed(solid_cylinder(std::max(radius, least / 2), std::max(length, least)), axes_about(axes[along]), at);
    }
    if (determinant(axes) < 0)
      for (double& x : axes[2]) x = -x;
    return placed(solid_box(thick(edges_of_box(squares))), axes, at);
  }

  static double determinant(const std::array<Solid::Point, 3>& a) {
    Eigen::Matrix3d m;
    for (Index i = 0; i < 3; ++i)
      for (Index j = 0; j < 3; ++j) m(i, j) = a[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
    return m.determinant();
  }

  static Solid::Point thick(Solid::Point lengths) {
    const double greatest = *std::max_element(lengths.begin(), lengths.end());
    for (double& length : lengths) length = std::max(length, least_share * greatest);
    return lengths;
  }

  const SceneRigidBody& body_;
  const Constants& constants_;
  std::size_t d_;
};

/// A solid that is much larger than what is around it, at half that size.
Solid fitted(Solid solid, double extent) {
  constexpr double much = 5;
  const double radius = solid.radius();
  if (!(extent > 0) || radius <= much * extent) return solid;
  const Solid::Point centre = solid.centre();
  for (Solid::Point& corner : solid.corners)
    for (std::size_t i = 0; i < 3; ++i) corner[i] = centre[i] + (corner[i] - centre[i]) * extent / (2 * radius);
  return solid;
}

}  // namespace

Solid::Point edges_of_box(const Solid::Point& mean_squares) {
  Solid::Point lengths{};
  constexpr double of_a_unit = 12;  // of a rod of length 1, 1 over the mean square of the distance from its middle
  for (std::size_t i = 0; i < 3; ++i) lengths[i] = std::sqrt(of_a_unit * std::max(mean_squares[i], double{0}));
  return lengths;
}

Solid body_shape(const SceneRigidBody& body, const Constants& constants, double extent) {
  const Shaper shaper(body, constants);
  return body.shape && shaper.has_size(*body.shape) ? shaper.by_shape(*body.shape)
                                                    : fitted(shaper.by_inertia(), extent);
}

}  // namespace hbvm::core
