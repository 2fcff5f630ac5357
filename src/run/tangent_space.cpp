#include "run/tangent_space.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>

#include "linear/norm.hpp"
#include "linear/product.hpp"
#include "scene/nearest_position.hpp"

namespace hbvm::core {

TangentSpace::TangentSpace(const Problem<Mpfr>& problem, const PhaseState& start)
    : problem_(problem), point_(problem), q_scale_(max_norm(start.q)), p_scale_(max_norm(start.p)) {
  if (q_scale_ == 0) q_scale_ = 1;
  const Vector<Mpfr> all = Vector<Mpfr>::Constant(problem.m(), q_scale_);
  if (p_scale_ == 0) p_scale_ = max_norm(problem.mass.momentum(all));
}

Vector<Mpfr> TangentSpace::change(const PhaseState& a, const PhaseState& b, const Mpfr& by) const {
  const Index m = problem_.m();
  Vector<Mpfr> change(2 * m);
  change.head(m) = (a.q - b.q) / (by * q_scale_);
  change.tail(m) = (a.p - b.p) / (by * p_scale_);
  return change;
}

PhaseState TangentSpace::moved(const PhaseState& from, const Vector<Mpfr>& change) {
  const Index m = problem_.m();
  PhaseState there{from.q + q_scale_ * change.head(m), from.p + p_scale_ * change.tail(m)};
  if (problem_.nu() > 0) there.q = nearest_position(problem_, there.q);
  there.p = point_.tangential(there.q, there.p);
  return there;
}

Matrix<Mpfr> TangentSpace::basis(const PhaseState& at, const Mpfr& small) {
  const Index m = problem_.m(), n = dimension();
  std::vector<Vector<Mpfr>> left;
  for (Index j = 0; j < 2 * m; ++j)
    left.push_back(change(moved(at, small * Vector<Mpfr>(Vector<Mpfr>::Unit(2 * m, j))), at, small));
  Matrix<Mpfr> basis(2 * m, n);
  for (Index i = 0; i < n; ++i) {
    std::size_t longest = 0;
    for (std::size_t j = 1; j < left.size(); ++j)
      if (norm(left[j]) > norm(left[longest])) longest = j;
    const Vector<Mpfr> unit = left[longest] / norm(left[longest]);
    basis.col(i) = unit;
    for (Vector<Mpfr>& vector : left) vector -= unit * dot(unit, vector);
  }
  return basis;
}

Matrix<Mpfr> TangentSpace::unscaled(const Matrix<Mpfr>& changes) const {
  const Index m = problem_.m();
  Matrix<Mpfr> result = changes;
  result.topRows(m) *= q_scale_;
  result.bottomRows(m) *= p_scale_;
  return result;
}

std::vector<std::complex<double>> multipliers_of(const Matrix<Mpfr>& start, const Matrix<Mpfr>& end) {
  const auto near = [](const Matrix<Mpfr>& x) {
    return Eigen::MatrixXd(x.unaryExpr([](const Mpfr& entry) { return approximately(entry); }));
  };
  const Eigen::MatrixXd monodromy = near(start).colPivHouseholderQr().solve(near(end));
  const Eigen::VectorXcd eigenvalues = monodromy.eigenvalues();
  std::vector<std::complex<double>> multipliers(eigenvalues.begin(), eigenvalues.end());
  std::stable_sort(multipliers.begin(), multipliers.end(),
                   [](const auto& a, const auto& b) { return std::abs(a) > std::abs(b); });
  return multipliers;
}

}  // namespace hbvm::core
