#include "scheme/stability.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <numbers>

#include "scalar/scalar.hpp"

namespace hbvm::core {
namespace {

/// What rounding leaves of equality.
const double slack = std::sqrt(epsilon<double>()) / 16;

/// The last place that is inside, between one that is and one that is not.
template <class Inside>
double last_inside(double inside, double outside, const Inside& is_inside) {
  for (int n = 0; n < 40; ++n) {
    const double middle = (inside + outside) / 2;
    (is_inside(middle) ? inside : outside) = middle;
  }
  return inside;
}

}  // namespace

LinearStability::LinearStability(Eigen::MatrixXd A, Eigen::VectorXd b) : A_(std::move(A)), b_(std::move(b)) {}

LinearStability::Complex LinearStability::R(Complex z) const {
  const Eigen::Index s = b_.size();
  const Eigen::MatrixXcd system = Eigen::MatrixXcd::Identity(s, s) - z * A_.cast<Complex>();
  const Eigen::VectorXcd ones = Eigen::VectorXcd::Ones(s);
  return Complex(1) + z * b_.cast<Complex>().dot(system.partialPivLu().solve(ones));
}

bool LinearStability::is_stable(Complex z) const { return std::abs(R(z)) <= 1 + slack; }

double LinearStability::interval(Complex direction) const {
  constexpr double step = 1 / double(256), farthest = 100;
  const auto is_inside = [&](double x) { return is_stable(x * direction); };
  double inside = 0;
  while (inside < farthest && is_inside(inside + step)) inside += step;
  const double end = last_inside(inside, inside + step, is_inside);
  return end < step ? 0 : end;
}

std::optional<double> LinearStability::at_infinity() const {
  const Eigen::FullPivLU<Eigen::MatrixXd> lu(A_);
  if (!lu.isInvertible()) return std::nullopt;
  const double limit = 1 - b_.dot(lu.solve(Eigen::VectorXd::Ones(b_.size())));
  return std::abs(limit) < 4'096 * epsilon<double>() ? 0 : limit;
}

bool LinearStability::is_stable_along(double degrees) const {
  constexpr int points = 1'000;
  constexpr double smallest = -10, greatest = 14;  // as powers of 2
  const Complex direction = std::polar(double(1), (180 - degrees) * std::numbers::pi / 180);
  for (int n = 0; n <= points; ++n)
    if (!is_stable(std::exp2(smallest + (greatest - smallest) * n / points) * direction)) return false;
  return true;
}

double LinearStability::angle() const {
  constexpr double right_angle = 90;
  // |R| is greatest on the edge of a sector without poles: these are where A has the eigenvalue 1/z.
  double without_poles = right_angle;
  const Eigen::VectorXcd eigenvalues = A_.eigenvalues();
  for (Eigen::Index i = 0; i < eigenvalues.size(); ++i)
    if (std::abs(eigenvalues[i]) > slack && eigenvalues[i].real() < -slack)
      without_poles = std::min(without_poles, 180 - std::abs(std::arg(eigenvalues[i])) * 180 / std::numbers::pi);
  const auto is_inside = [&](double degrees) { return degrees <= without_poles && is_stable_along(degrees); };
  if (is_inside(right_angle)) return right_angle;
  return is_inside(0) ? last_inside(0, right_angle, is_inside) : 0;
}

bool is_algebraically_stable(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  if (b.minCoeff() < -slack) return false;
  const Eigen::MatrixXd product = b.asDiagonal() * A;
  const Eigen::MatrixXd M = product + product.transpose() - b * b.transpose();
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(M).eigenvalues().minCoeff() >= -slack;
}

double ssp_coefficient(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  const Eigen::Index s = b.size();
  if (A.minCoeff() < -slack || b.minCoeff() < -slack) return 0;
  // Stages and the end are combinations of the start and of Euler steps of stages, none with a negative weight.
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(s + 1, s + 1);
  K.topLeftCorner(s, s) = A;
  K.row(s).head(s) = b.transpose();
  const auto is_monotone = [&](double r) {
    const Eigen::FullPivLU<Eigen::MatrixXd> lu(Eigen::MatrixXd::Identity(s + 1, s + 1) + r * K);
    if (!lu.isInvertible()) return false;
    return lu.solve(Eigen::MatrixXd(r * K)).minCoeff() >= -slack &&
           lu.solve(Eigen::VectorXd::Ones(s + 1)).minCoeff() >= -slack;
  };
  constexpr double least = 1 / double(1'024), most = 1'048'576;
  if (!is_monotone(least)) return 0;
  double inside = least;
  while (inside < most && is_monotone(2 * inside)) inside *= 2;
  if (inside >= most) return std::numeric_limits<double>::infinity();
  return last_inside(inside, 2 * inside, is_monotone);
}

}  // namespace hbvm::core
