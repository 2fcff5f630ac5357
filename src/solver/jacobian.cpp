#include "solver/jacobian.hpp"

#include <algorithm>
#include <cmath>

#include "scalar/binary_exponent.hpp"

namespace hbvm::core {
namespace {

template <Scalar S>
std::vector<std::vector<std::pair<Index, S>>> inverse_mass_rows(const MassMatrix<S>& mass) {
  std::vector<std::vector<std::pair<Index, S>>> rows(static_cast<std::size_t>(mass.m()));
  for (const auto& block : mass.blocks())
    for (Index i = 0; i < block.size; ++i)
      for (Index j = 0; j < block.size; ++j) {
        const S w = block.full ? block.W(i, j) : i == j ? block.inverse_mass : S(0);
        if (w != 0) rows[static_cast<std::size_t>(block.offset + i)].emplace_back(block.offset + j, w);
      }
  return rows;
}

}  // namespace

template <Scalar S>
Jacobian<S>::Jacobian(const Problem<S>& problem, const Hbvm<S>& method)
    : problem_(problem),
      method_(method),
      curvature_(problem, method.k, method.r),
      slopes_(problem, method.k),
      bodies_(problem.mass.of_bodies()),
      W_(inverse_mass_rows(problem.mass)),
      X_hat_(method.X_s.lazyProduct(method.projection_hat)),
      X_projection_(method.X_s.lazyProduct(method.projection)) {
  const Index m = bodies_, nu = problem.nu(), s = method.s;
  const ConstraintGradient<S> gradient(problem, 1);
  std::vector<std::pair<Index, Index>> entries;
  const auto couple = [&](const auto& pair) {
    if (pair.row >= m) return;
    for (const auto& [column, w] : W_[static_cast<std::size_t>(pair.column)]) entries.emplace_back(pair.row, column);
  };
  std::ranges::for_each(curvature_.pairs(), couple);
  std::ranges::for_each(slopes_.pairs(), couple);
  for (Index a = 0; a < nu; ++a) {
    for (const Index j : gradient.pattern(a).coordinates)
      if (j < m) entries.emplace_back(m + a, j);
    for (const Index j : gradient.weighted_pattern(a).coordinates) entries.emplace_back(m + a, j);
  }
  order_ = order_for_band(m + nu, entries);
  n_ = s * (m + nu);
  const Index half_bandwidth = s * (order_.half_bandwidth + 1) - 1;
  matrix_.resize(n_, half_bandwidth);
  x_.resize(n_);
  for (const auto& block : problem.mass.blocks())
    for (Index i = 0; i < block.size; ++i)
      coordinate_exponents_.push_back(binary_exponent(block.full ? block.M(i, i) : block.mass));
  coordinate_exponents_.resize(static_cast<std::size_t>(problem.m()));
  row_exponents_.resize(static_cast<std::size_t>(nu));
  column_exponents_.resize(static_cast<std::size_t>(nu));
  row_factors_.assign(static_cast<std::size_t>(n_), S(1));
  column_factors_ = row_factors_;
  block_.resize(s, s);
  weighted_.resize(s, std::max(method.k, method.r));
  curved_.resize(method.r, static_cast<Index>(curvature_.pairs().size()));
  at_nodes_.resize(method.r);
  parts_ = {{"matrix of the Jacobian", 0, assembly_operations()},
            {"factors of the Jacobian", 0, matrix_.factor_operations()},
            {"corrections", 0, matrix_.solve_operations()}};
}

template <Scalar S>
OperationCounts Jacobian<S>::assembly_operations() const {
  const Index s = method_.s, k = method_.k, r = method_.r, square = s * s;
  // Of a block of coefficients, from one at the nodes.
  const bool coefficients = method_.has_coefficients_of_lambda();
  const auto add_block = [&](OperationCounts& to) {
    if (coefficients) to.add_products(square * r), to.add(Op::multiply, s * r);
  };
  const auto weights = [&](Index column) { return static_cast<Index>(W_[static_cast<std::size_t>(column)].size()); };
  OperationCounts counts;
  counts.add_products(r * static_cast<Index>(curvature_.constraints().size()));
  for (const auto& second : curvature_.varying_constraints()) {
    counts.add_products(r);
    add_block(counts);
    counts.add_products(square * weights(curvature_.pairs()[static_cast<std::size_t>(second.pair)].column));
  }
  for (const auto& pair : curvature_.pairs()) {
    counts.add_products((k + r) * square);
    counts.add(Op::multiply, (k + r) * (s + 1));
    counts.add_products(weights(pair.column) * square);
  }
  for (const auto& pair : slopes_.pairs()) {
    counts.add_products((2 * k + weights(pair.column)) * square);
    counts.add(Op::multiply, 2 * k * (s + 1));
  }
  const ConstraintGradient<S> gradient(problem_, 1);
  for (Index a = 0; a < problem_.nu(); ++a) {
    counts.add(Op::multiply, square * static_cast<Index>(gradient.pattern(a).coordinates.size()));
    counts.add_products(square * static_cast<Index>(gradient.weighted_pattern(a).coordinates.size()));
    for (std::size_t l = 0; l < gradient.pattern(a).coordinates.size(); ++l) add_block(counts);
    for (std::size_t l = 0; l < gradient.weighted_pattern(a).coordinates.size(); ++l) add_block(counts);
  }
  for (const auto& second : curvature_.constraints()) {
    add_block(counts);
    const Index entries = square * weights(curvature_.pairs()[static_cast<std::size_t>(second.pair)].column);
    counts.add_products(entries);
    counts.add(Op::multiply, 3 * entries);
  }
  return counts;
}

template <Scalar S>
bool Jacobian<S>::factor(const StageEquations<S>& at, const Matrix<S>& lambda) {
  {
    const PartCall counted(parts_[assembly]);
    assemble(at, lambda);
    choose_scales(at.constraint_gradient());
    scale();
  }
  const PartCall counted(parts_[factors]);
  return matrix_.factor();
}

template <Scalar S>
void Jacobian<S>::add_weighted(const S& factor, const Matrix<S>& X, const S* w, const Matrix<S>& I) {
  const Index nodes = X.cols();
  // Most pairs of coordinates are curved by U alone or by g alone.
  if (std::all_of(w, w + nodes, [](const S& weight) { return weight == 0; })) return;
  auto weighted = weighted_.leftCols(nodes);
  for (Index n = 0; n < nodes; ++n) weighted.col(n) = S(factor * w[n]) * X.col(n);
  if constexpr (std::same_as<S, double>)
    block_.noalias() += weighted * I;
  else
    block_ += weighted.lazyProduct(I);
}

template <Scalar S>
void Jacobian<S>::assemble(const StageEquations<S>& at, const Matrix<S>& lambda) {
  const Index m = bodies_, nu = problem_.nu(), s = method_.s;
  const S& h = at.step();
  const S h2 = h * h;
  matrix_.set_zero();
  for (Index j = 0; j < m; ++j)
    for (Index i = 0; i < s; ++i) matrix_.entry(of_coordinate(j) + i, of_coordinate(j) + i) = 1;

  // The second derivatives, of U at the k nodes and of g lambda at the r nodes.
  const Matrix<S>& hessian = curvature_.potential(lanes(at.quadrature_positions()));
  curved_.setZero();
  const Index r = method_.r;
  const Matrix<S>& multipliers = at.node_multipliers(lambda);
  for (const auto& second : curvature_.constraints())
    for (Index n = 0; n < r; ++n) curved_(n, second.pair) += second.value * multipliers(n, second.constraint);
  const auto& varying = curvature_.varying_constraints();
  const Matrix<S>* const curvatures = varying.empty() ? nullptr : &curvature_.varying(lanes(at.node_positions()));
  for (std::size_t e = 0; e < varying.size(); ++e)
    for (Index n = 0; n < r; ++n)
      curved_(n, varying[e].pair) += (*curvatures)(n, static_cast<Index>(e)) * multipliers(n, varying[e].constraint);
  for (std::size_t p = 0; p < curvature_.pairs().size(); ++p) {
    const auto& pair = curvature_.pairs()[p];
    if (pair.row >= m) continue;
    const auto second = static_cast<Index>(p);
    block_.setZero();
    add_weighted(-h2, X_hat_, &hessian(0, second), method_.I_hat);
    add_weighted(h2, X_projection_, &curved_(0, second), method_.I_s);
    spread_block(pair.row, pair.column);
  }
  if (!slopes_.pairs().empty()) slopes_.evaluate(lanes(at.quadrature_positions()), lanes(at.quadrature_velocities()));
  for (std::size_t p = 0; p < slopes_.pairs().size(); ++p) {
    const auto slope = static_cast<Index>(p);
    block_.setZero();
    add_weighted(-h2, X_hat_, &slopes_.by_position()(0, slope), method_.I_hat);
    add_weighted(-h, X_hat_, &slopes_.by_velocity()(0, slope), method_.P_hat);
    spread_block(slopes_.pairs()[p].row, slopes_.pairs()[p].column);
  }

  const ConstraintGradient<S>& gradient = at.constraint_gradient();
  const bool coefficients = method_.has_coefficients_of_lambda();
  for (Index a = 0; a < nu; ++a) {
    const auto& own = gradient.pattern(a);
    const auto& weighted = gradient.weighted_pattern(a);
    // Driven coordinates are the last.
    const auto moving =
        static_cast<std::size_t>(std::ranges::lower_bound(own.coordinates, m) - own.coordinates.begin());
    if (coefficients) {
      for (std::size_t l = 0; l < moving; ++l) {
        block_.setZero();
        add_weighted(S(1), X_projection_, &gradient.values()(0, own.first + static_cast<Index>(l)), method_.P_s);
        for (Index j = 0; j < s; ++j)
          for (Index i = 0; i < s; ++i)
            matrix_.entry(of_coordinate(own.coordinates[l]) + i, of_multiplier(a) + j) = block_(i, j);
      }
      for (std::size_t l = 0; l < weighted.coordinates.size(); ++l) {
        set_rows(&gradient.weighted_values()(0, weighted.first + static_cast<Index>(l)), method_.P_s);
        add_rows(a, weighted.coordinates[l], S(1));
      }
      continue;
    }
    for (std::size_t l = 0; l < moving; ++l)
      for (Index n = 0; n < s; ++n)
        for (Index i = 0; i < s; ++i)
          matrix_.entry(of_coordinate(own.coordinates[l]) + i, of_multiplier(a) + n) =
              X_projection_(i, n) * gradient.values()(n, own.first + static_cast<Index>(l));
    for (std::size_t l = 0; l < weighted.coordinates.size(); ++l)
      for (Index j = 0; j < s; ++j)
        for (Index n = 0; n < s; ++n)
          matrix_.entry(of_multiplier(a) + n, of_coordinate(weighted.coordinates[l]) + j) +=
              method_.P_s(n, j) * gradient.weighted_values()(n, weighted.first + static_cast<Index>(l));
  }
  // h I_nj D_n^T W, of which D_n has the velocity at the node.
  const auto add_curved = [&](Index constraint, Index pair_number, auto second_at) {
    const auto& pair = curvature_.pairs()[static_cast<std::size_t>(pair_number)];
    for (Index n = 0; n < r; ++n) at_nodes_[n] = h * second_at(n) * at.node_velocities()(n, pair.row);
    set_rows(at_nodes_.data(), method_.I_s);
    for (const auto& [column, w] : W_[static_cast<std::size_t>(pair.column)]) add_rows(constraint, column, w);
  };
  for (std::size_t e = 0; e < varying.size(); ++e)
    add_curved(varying[e].constraint, varying[e].pair,
               [&](Index n) -> const S& { return (*curvatures)(n, static_cast<Index>(e)); });
  for (const auto& second : curvature_.constraints()) {
    if (coefficients) {
      add_curved(second.constraint, second.pair, [&](Index) -> const S& { return second.value; });
      continue;
    }
    const auto& pair = curvature_.pairs()[static_cast<std::size_t>(second.pair)];
    for (const auto& [column, w] : W_[static_cast<std::size_t>(pair.column)])
      for (Index j = 0; j < s; ++j)
        for (Index n = 0; n < s; ++n)
          matrix_.entry(of_multiplier(second.constraint) + n, of_coordinate(column) + j) +=
              h * method_.I_s(n, j) * second.value * at.node_velocities()(n, pair.row) * w;
  }
}

template <Scalar S>
void Jacobian<S>::spread_block(Index row, Index column) {
  const Index s = method_.s;
  for (const auto& [other, w] : W_[static_cast<std::size_t>(column)])
    for (Index j = 0; j < s; ++j)
      for (Index i = 0; i < s; ++i) matrix_.entry(of_coordinate(row) + i, of_coordinate(other) + j) += block_(i, j) * w;
}

template <Scalar S>
void Jacobian<S>::set_rows(const S* w, const Matrix<S>& F) {
  block_.setZero();
  if (method_.has_coefficients_of_lambda())
    add_weighted(S(1), method_.projection, w, F);
  else
    for (Index j = 0; j < F.cols(); ++j)
      for (Index n = 0; n < F.rows(); ++n) block_(n, j) = w[n] * F(n, j);
}

template <Scalar S>
void Jacobian<S>::add_rows(Index constraint, Index coordinate, const S& factor) {
  const Index s = method_.s;
  for (Index j = 0; j < s; ++j)
    for (Index i = 0; i < s; ++i)
      matrix_.entry(of_multiplier(constraint) + i, of_coordinate(coordinate) + j) += block_(i, j) * factor;
}

template <Scalar S>
void Jacobian<S>::choose_scales(const ConstraintGradient<S>& gradient) {
  const Index m = bodies_, nu = problem_.nu(), s = method_.s;
  const auto exponent = [](const Matrix<S>& values, Index first, std::size_t columns) {
    S largest = 0;
    for (Index i = first * values.rows(); i < (first + static_cast<Index>(columns)) * values.rows(); ++i)
      raise_magnitude(largest, values.data()[i]);
    return largest == 0 ? 0 : binary_exponent(largest);
  };
  const auto set_factors = [&](Index first, long row, long column) {
    for (Index i = first; i < first + s; ++i) {
      row_factors_[static_cast<std::size_t>(i)] = power_of_two<S>(-row);
      column_factors_[static_cast<std::size_t>(i)] = power_of_two<S>(column);
    }
  };
  for (Index j = 0; j < m; ++j) set_factors(of_coordinate(j), coordinate_exponent(j), coordinate_exponent(j));
  for (Index a = 0; a < nu; ++a) {
    const auto n = static_cast<std::size_t>(a);
    row_exponents_[n] = exponent(gradient.values(), gradient.pattern(a).first, gradient.pattern(a).coordinates.size());
    column_exponents_[n] = -exponent(gradient.weighted_values(), gradient.weighted_pattern(a).first,
                                     gradient.weighted_pattern(a).coordinates.size());
    set_factors(of_multiplier(a), row_exponents_[n], column_exponents_[n]);
  }
}

template <Scalar S>
void Jacobian<S>::scale() {
  const Index b = matrix_.half_bandwidth();
  for (Index j = 0; j < n_; ++j)
    for (Index i = std::max<Index>(0, j - b); i <= std::min(n_ - 1, j + b); ++i) {
      S& entry = matrix_.entry(i, j);
      if (entry == 0) continue;
      set_product(entry, entry, row_factors_[static_cast<std::size_t>(i)]);
      set_product(entry, entry, column_factors_[static_cast<std::size_t>(j)]);
    }
}

template <Scalar S>
void Jacobian<S>::solve(StageResidual<S>& r) {
  const auto divide = [&](Matrix<S>& residual, Index column, Index first) {
    for (Index i = 0; i < residual.rows(); ++i)
      set_product(residual(i, column), residual(i, column), row_factors_[static_cast<std::size_t>(first + i)]);
  };
  for (Index j = 0; j < bodies_; ++j) divide(r.momentum, j, of_coordinate(j));
  for (Index a = 0; a < problem_.nu(); ++a) divide(r.constraint, a, of_multiplier(a));
  solve_scaled(r);
}

template <Scalar S>
void Jacobian<S>::solve_scaled(StageResidual<S>& r) {
  const PartCall counted(parts_[corrections]);
  const Index m = bodies_, nu = problem_.nu(), s = method_.s;
  for (Index j = 0; j < m; ++j)
    for (Index i = 0; i < s; ++i) set(x_[of_coordinate(j) + i], r.momentum(i, j));
  for (Index a = 0; a < nu; ++a)
    for (Index i = 0; i < s; ++i) set(x_[of_multiplier(a) + i], r.constraint(i, a));
  matrix_.solve(x_);
  for (Index i = 0; i < n_; ++i) set_product(x_[i], x_[i], column_factors_[static_cast<std::size_t>(i)]);
  for (Index j = 0; j < m; ++j)
    for (Index i = 0; i < s; ++i) set(r.momentum(i, j), x_[of_coordinate(j) + i]);
  for (Index a = 0; a < nu; ++a)
    for (Index i = 0; i < s; ++i) set(r.constraint(i, a), x_[of_multiplier(a) + i]);
}

#define HBVM_DEFINE(S) template class Jacobian<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
