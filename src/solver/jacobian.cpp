#include "hbvm/solver/jacobian.hpp"

namespace hbvm {
namespace {

std::vector<std::vector<std::pair<Index, double>>> inverse_mass_rows(const MassMatrix<double>& mass) {
  std::vector<std::vector<std::pair<Index, double>>> rows(static_cast<std::size_t>(mass.m()));
  for (const auto& block : mass.blocks())
    for (Index i = 0; i < block.size; ++i)
      for (Index j = 0; j < block.size; ++j) {
        const double w = block.full ? block.W(i, j) : i == j ? block.inverse_mass : 0;
        if (w != 0) rows[static_cast<std::size_t>(block.offset + i)].emplace_back(block.offset + j, w);
      }
  return rows;
}

}  // namespace

Jacobian::Jacobian(const Problem<double>& problem, const Hbvm<double>& method, double step)
    : problem_(problem),
      method_(method),
      h_(step),
      curvature_(problem, method.k),
      W_(inverse_mass_rows(problem.mass)),
      X_hat_(method.X_s * method.projection_hat),
      X_projection_(method.X_s * method.projection) {
  const Index m = problem.m(), nu = problem.nu(), s = method.s;
  const ConstraintGradient<double> gradient(problem, 1);
  std::vector<std::pair<Index, Index>> entries;
  for (const auto& pair : curvature_.pairs())
    for (const auto& [column, w] : W_[static_cast<std::size_t>(pair.column)]) entries.emplace_back(pair.row, column);
  for (Index a = 0; a < nu; ++a) {
    for (const Index j : gradient.pattern(a).coordinates) entries.emplace_back(m + a, j);
    for (const Index j : gradient.weighted_pattern(a).coordinates) entries.emplace_back(m + a, j);
  }
  order_ = order_for_band(m + nu, entries);
  n_ = s * (m + nu);
  const Index half_bandwidth = s * (order_.half_bandwidth + 1) - 1;
  matrix_.resize(n_, half_bandwidth);
  x_.resize(n_);
  block_.resize(s, s);
  curved_.resize(s, static_cast<Index>(curvature_.pairs().size()));
}

bool Jacobian::factor(const StageEquations<double>& at, const Matrix<double>& lambda) {
  ++factorisations_;
  assemble(at, lambda);
  return matrix_.factor();
}

void Jacobian::assemble(const StageEquations<double>& at, const Matrix<double>& lambda) {
  const Index m = problem_.m(), nu = problem_.nu(), s = method_.s, k = method_.k;
  matrix_.set_zero();
  for (Index j = 0; j < m; ++j)
    for (Index i = 0; i < s; ++i) matrix_.entry(of_coordinate(j) + i, of_coordinate(j) + i) = 1;

  // The second derivatives, of U at the k nodes and of g lambda at the s nodes.
  const Matrix<double>& hessian = curvature_.potential(lanes(at.quadrature_positions()));
  curved_.setZero();
  for (const auto& second : curvature_.constraints())
    for (Index n = 0; n < s; ++n) curved_(n, second.pair) += second.value * lambda(n, second.constraint);
  for (std::size_t p = 0; p < curvature_.pairs().size(); ++p) {
    const auto& pair = curvature_.pairs()[p];
    const auto second = static_cast<Index>(p);
    block_.setZero();
    for (Index j = 0; j < s; ++j) {
      for (Index n = 0; n < k; ++n) block_.col(j) -= hessian(n, second) * method_.I_hat(n, j) * X_hat_.col(n);
      for (Index n = 0; n < s; ++n) block_.col(j) += curved_(n, second) * method_.I_s(n, j) * X_projection_.col(n);
    }
    block_ *= h_ * h_;
    for (const auto& [column, w] : W_[static_cast<std::size_t>(pair.column)])
      for (Index j = 0; j < s; ++j)
        for (Index i = 0; i < s; ++i)
          matrix_.entry(of_coordinate(pair.row) + i, of_coordinate(column) + j) += block_(i, j) * w;
  }

  const ConstraintGradient<double>& gradient = at.constraint_gradient();
  for (Index a = 0; a < nu; ++a) {
    const auto& own = gradient.pattern(a);
    for (std::size_t l = 0; l < own.coordinates.size(); ++l)
      for (Index n = 0; n < s; ++n)
        for (Index i = 0; i < s; ++i)
          matrix_.entry(of_coordinate(own.coordinates[l]) + i, of_multiplier(a) + n) =
              X_projection_(i, n) * gradient.values()(n, own.first + static_cast<Index>(l));
    const auto& weighted = gradient.weighted_pattern(a);
    for (std::size_t l = 0; l < weighted.coordinates.size(); ++l)
      for (Index j = 0; j < s; ++j)
        for (Index n = 0; n < s; ++n)
          matrix_.entry(of_multiplier(a) + n, of_coordinate(weighted.coordinates[l]) + j) +=
              method_.P_s(n, j) * gradient.weighted_values()(n, weighted.first + static_cast<Index>(l));
  }
  for (const auto& second : curvature_.constraints()) {
    const auto& pair = curvature_.pairs()[static_cast<std::size_t>(second.pair)];
    for (const auto& [column, w] : W_[static_cast<std::size_t>(pair.column)])
      for (Index j = 0; j < s; ++j)
        for (Index n = 0; n < s; ++n)
          matrix_.entry(of_multiplier(second.constraint) + n, of_coordinate(column) + j) +=
              h_ * method_.I_s(n, j) * second.value * at.node_velocities()(n, pair.row) * w;
  }
}

void Jacobian::solve(StageResidual<double>& r) {
  ++solutions_;
  const Index m = problem_.m(), nu = problem_.nu(), s = method_.s;
  for (Index j = 0; j < m; ++j)
    for (Index i = 0; i < s; ++i) x_[of_coordinate(j) + i] = r.momentum(i, j);
  for (Index a = 0; a < nu; ++a)
    for (Index i = 0; i < s; ++i) x_[of_multiplier(a) + i] = r.constraint(i, a);
  matrix_.solve(x_);
  for (Index j = 0; j < m; ++j)
    for (Index i = 0; i < s; ++i) r.momentum(i, j) = x_[of_coordinate(j) + i];
  for (Index a = 0; a < nu; ++a)
    for (Index i = 0; i < s; ++i) r.constraint(i, a) = x_[of_multiplier(a) + i];
}

}  // namespace hbvm
