#include "ball_stages.hpp"

namespace hbvm::core {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

using Entry = BallConstraint::Entry;

/// The second derivatives of an effect, or of g by a formula.
std::vector<Entry> second_derivatives(const BallForce& force, const std::vector<BallSeries>& q) {
  const std::vector<BallSeries> h = force.hessian.outputs(force.inputs(q), 1);
  std::vector<Entry> result;
  force.for_each_second([&](std::size_t output, Index row, Index column, const RealBall& weight) {
    if (h[output].length() > 0) result.push_back({row, column, h[output][0] * weight});
  });
  return result;
}

/// to += factor x, a block of it whose corner that is.
void add_block(BallMatrix& to, Index row, Index column, const RealBall& factor, const BallMatrix& x) {
  for (Index i = 0; i < x.rows(); ++i)
    for (Index j = 0; j < x.columns(); ++j)
      if (arb_is_zero(x(i, j)) == 0) arb_addmul(to(row + i, column + j), x(i, j), raw(factor), BallScope::bits());
}

}  // namespace

std::vector<BallSeries> BallStages::position(const StageBox& box, const BallMatrix& I, Index node) const {
  std::vector<RealBall> sum(at(problem_.m()));
  for (Index j = 0; j < problem_.m(); ++j)
    for (Index l = 0; l < method_.s; ++l) sum[at(j)].add_product(I.at(node, l), box.unknowns.at(of_gamma(l, j), 0));
  std::vector<RealBall> u = problem_.velocity(sum);
  for (Index j = 0; j < problem_.m(); ++j) u[at(j)] = box.start.at(j, 0) + h_ * u[at(j)];
  return as_series(u);
}

std::vector<RealBall> BallStages::velocity(const StageBox& box, Index node) const {
  std::vector<RealBall> v(at(problem_.m()));
  for (Index j = 0; j < problem_.m(); ++j)
    for (Index l = 0; l < method_.s; ++l)
      v[at(j)].add_product(method_.P.at(node, l), box.unknowns.at(of_gamma(l, j), 0));
  return problem_.velocity(v);
}

RealBall BallStages::share(Index node, Index l) const {
  return method_.has_coefficients_of_lambda() ? method_.P.at(node, l) : RealBall(node == l ? 1 : 0);
}

RealBall BallStages::row_weight(Index l, Index node) const {
  return method_.has_coefficients_of_lambda() ? method_.b[at(node)] * method_.P.at(node, l)
                                              : RealBall(node == l ? 1 : 0);
}

std::vector<RealBall> BallStages::multipliers(const StageBox& box, Index node) const {
  std::vector<RealBall> lambda(at(problem_.nu()));
  for (Index a = 0; a < problem_.nu(); ++a)
    for (Index l = 0; l < method_.s; ++l)
      lambda[at(a)].add_product(share(node, l), box.unknowns.at(of_lambda(l, a), 0));
  return lambda;
}

BallMatrix BallStages::mirrored(const BallMatrix& unknowns) const {
  // P_l(1 - c) = (-1)^l P_l(c), and nodes lie as far from both ends.
  const Index s = method_.s;
  const bool coefficients = method_.has_coefficients_of_lambda();
  BallMatrix result = unknowns;
  for (Index l = 0; l < s; ++l) {
    const bool odd = l % 2 != 0;
    for (Index j = 0; j < problem_.m() && !odd; ++j) result.set(of_gamma(l, j), 0, -unknowns.at(of_gamma(l, j), 0));
    for (Index a = 0; a < problem_.nu(); ++a) {
      const RealBall lambda = unknowns.at(of_lambda(coefficients ? l : s - 1 - l, a), 0);
      result.set(of_lambda(l, a), 0, coefficients && odd ? -lambda : lambda);
    }
  }
  return result;
}

std::vector<RealBall> BallStages::multipliers_at_end(const BallMatrix& unknowns) const {
  std::vector<RealBall> lambda(at(problem_.nu()));
  for (Index a = 0; a < problem_.nu(); ++a)
    for (Index l = 0; l < method_.s; ++l)
      lambda[at(a)].add_product(method_.lambda_at_1[at(l)], unknowns.at(of_lambda(l, a), 0));
  return lambda;
}

StageImage BallStages::image(const StageBox& box) const {
  const Index m = problem_.m(), nu = problem_.nu(), s = method_.s;
  StageImage result{BallMatrix(unknowns(), 1), BallMatrix(2 * m, 1)};
  BallMatrix pull(s, m);  // psi_hat - zeta
  for (Index i = 0; i < method_.k; ++i) {
    const std::vector<BallSeries> force = problem_.force(position(box, method_.I_hat, i), 1);
    for (Index l = 0; l < s; ++l) {
      const RealBall weight = method_.b_hat[at(i)] * method_.P_hat.at(i, l);
      for (Index j = 0; j < m; ++j) pull.add(l, j, weight * force[at(j)][0]);
    }
  }
  for (Index i = 0; nu > 0 && i < method_.r; ++i) {
    const std::vector<BallSeries> u = position(box, method_.I, i);
    const std::vector<RealBall> v = velocity(box, i), lambda = multipliers(box, i);
    for (Index a = 0; a < nu; ++a) {
      RealBall hidden;
      for (const BallSlope& slope : problem_.slopes(a, u, 1)) {
        const RealBall of_g = slope.series[0];
        hidden.add_product(of_g, v[at(slope.coordinate)]);
        for (Index l = 0; l < s; ++l)
          pull.add(l, slope.coordinate, -(method_.b[at(i)] * method_.P.at(i, l) * of_g * lambda[at(a)]));
      }
      for (Index l = 0; l < s; ++l) result.residual.add(of_lambda(l, a), 0, row_weight(l, i) * hidden);
    }
  }
  std::vector<RealBall> first(at(m));
  for (Index j = 0; j < m; ++j) {
    first[at(j)] = box.unknowns.at(of_gamma(0, j), 0);
    for (Index l = 0; l < s; ++l) {
      RealBall sum;
      for (Index i = 0; i < s; ++i) sum.add_product(method_.X.at(l, i), pull.at(i, j));
      RealBall left = box.unknowns.at(of_gamma(l, j), 0) - h_ * sum;
      if (l == 0) left -= box.start.at(m + j, 0);
      result.residual.set(of_gamma(l, j), 0, left);
    }
    result.end.set(m + j, 0, box.start.at(m + j, 0) + h_ * pull.at(0, j));
  }
  const std::vector<RealBall> v = problem_.velocity(first);
  for (Index j = 0; j < m; ++j) result.end.set(j, 0, box.start.at(j, 0) + h_ * v[at(j)]);
  return result;
}

void BallStages::add_forces(const StageBox& box, Parts& parts) const {
  const Index m = problem_.m(), s = method_.s;
  for (Index i = 0; i < method_.k; ++i) {
    const std::vector<BallSeries> u = position(box, method_.I_hat, i);
    BallMatrix K(m, m);
    for (const BallForce& force : problem_.forces())
      for (const Entry& entry : second_derivatives(force, u)) K.add(entry.i, entry.j, entry.h);
    const BallMatrix K_W = K * problem_.W();
    for (Index l = 0; l < s; ++l) {
      const RealBall weight = method_.b_hat[at(i)] * method_.P_hat.at(i, l);
      add_block(parts.pull_by_q, of_gamma(l, 0), 0, weight, K);
      for (Index n = 0; n < s; ++n)
        add_block(parts.pull_by_gamma, of_gamma(l, 0), of_gamma(n, 0), h_ * weight * method_.I_hat.at(i, n), K_W);
    }
  }
}

void BallStages::add_constraints(const StageBox& box, Parts& parts) const {
  const Index m = problem_.m(), nu = problem_.nu(), s = method_.s;
  for (Index i = 0; i < method_.r; ++i) {
    const std::vector<BallSeries> u = position(box, method_.I, i);
    const std::vector<RealBall> v = velocity(box, i), lambda = multipliers(box, i);
    BallMatrix G(m, nu), L(m, m), D(nu, m);
    for (Index a = 0; a < nu; ++a) {
      for (const BallSlope& slope : problem_.slopes(a, u, 1)) G.set(slope.coordinate, a, slope.series[0]);
      const BallConstraint& constraint = problem_.constraints()[at(a)];
      for (const Entry& entry : constraint.formula ? second_derivatives(*constraint.formula, u) : constraint.second) {
        L.add(entry.i, entry.j, lambda[at(a)] * entry.h);
        D.add(a, entry.j, v[at(entry.i)] * entry.h);
      }
    }
    const BallMatrix L_W = L * problem_.W(), D_W = D * problem_.W(), GT_W = G.transposed() * problem_.W();
    for (Index l = 0; l < s; ++l) {
      const RealBall weight = -(method_.b[at(i)] * method_.P.at(i, l)), of_row = row_weight(l, i);
      add_block(parts.pull_by_q, of_gamma(l, 0), 0, weight, L);
      add_block(parts.hidden_by_q, l * nu, 0, of_row, D);
      for (Index n = 0; n < s; ++n) {
        add_block(parts.pull_by_gamma, of_gamma(l, 0), of_gamma(n, 0), h_ * weight * method_.I.at(i, n), L_W);
        add_block(parts.pull_by_lambda, of_gamma(l, 0), n * nu, weight * share(i, n), G);
        add_block(parts.hidden_by_gamma, l * nu, of_gamma(n, 0), of_row * method_.P.at(i, n), GT_W);
        add_block(parts.hidden_by_gamma, l * nu, of_gamma(n, 0), h_ * of_row * method_.I.at(i, n), D_W);
      }
    }
  }
}

StageDerivative BallStages::derivative(const StageBox& box) const {
  const Index m = problem_.m(), nu = problem_.nu(), s = method_.s, n = unknowns(), first_lambda = of_lambda(0, 0);
  Parts parts{BallMatrix(s * m, s * m), BallMatrix(s * m, s * nu), BallMatrix(s * m, m), BallMatrix(s * nu, s * m),
              BallMatrix(s * nu, m)};
  add_forces(box, parts);
  if (nu > 0) add_constraints(box, parts);
  StageDerivative result{BallMatrix(n, n), BallMatrix(n, 2 * m), BallMatrix(2 * m, n), BallMatrix(2 * m, 2 * m)};
  // (54) is gamma - e_1 p0 - h X_s (psi_hat - zeta).
  BallMatrix h_X(s * m, s * m);
  for (Index l = 0; l < s; ++l)
    for (Index i = 0; i < s; ++i)
      for (Index j = 0; j < m; ++j) h_X.set(of_gamma(l, j), of_gamma(i, j), h_ * method_.X.at(l, i));
  add_block(result.by_unknowns, 0, 0, RealBall(-1), h_X * parts.pull_by_gamma);
  add_block(result.by_unknowns, 0, first_lambda, RealBall(-1), h_X * parts.pull_by_lambda);
  add_block(result.by_start, 0, 0, RealBall(-1), h_X * parts.pull_by_q);
  for (Index i = 0; i < s * m; ++i) result.by_unknowns.add(i, i, 1);
  for (Index j = 0; j < m; ++j) result.by_start.set(j, m + j, -1);
  // The hidden constraints, (52).
  add_block(result.by_unknowns, first_lambda, 0, RealBall(1), parts.hidden_by_gamma);
  add_block(result.by_start, first_lambda, 0, RealBall(1), parts.hidden_by_q);
  // q1 and p1, (56).
  add_block(result.end_by_unknowns, 0, 0, h_, problem_.W());
  for (Index j = 0; j < m; ++j) {
    for (Index i = 0; i < s * m; ++i) result.end_by_unknowns.set(m + j, i, h_ * parts.pull_by_gamma.at(j, i));
    for (Index i = 0; i < s * nu; ++i)
      result.end_by_unknowns.set(m + j, first_lambda + i, h_ * parts.pull_by_lambda.at(j, i));
    for (Index i = 0; i < m; ++i) result.end_by_start.set(m + j, i, h_ * parts.pull_by_q.at(j, i));
    result.end_by_start.set(j, j, 1);
    result.end_by_start.set(m + j, m + j, 1);
  }
  return result;
}

}  // namespace hbvm::core
