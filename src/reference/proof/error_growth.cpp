#include "error_growth.hpp"

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>

#include "hbvm/error.hpp"

namespace hbvm::core {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
using Doubles = Eigen::MatrixXd;

std::size_t index(Index i) { return static_cast<std::size_t>(i); }

/// Doubles, and a bound of what each is off by.
struct Bounded {
  Doubles centre, radius;
};

Bounded in_double(const BallMatrix& x) {
  Bounded result{Doubles(x.rows(), x.columns()), Doubles(x.rows(), x.columns())};
  for (Index j = 0; j < x.columns(); ++j)
    for (Index i = 0; i < x.rows(); ++i) {
      const double centre = centre_of(x(i, j));
      const RealBall off = greatest_magnitude(x.at(i, j) - exact_ball(centre));
      result.centre(i, j) = centre;
      result.radius(i, j) = arf_get_d(arb_midref(raw(off)), ARF_RND_UP);
    }
  return result;
}

/// A bound of the greatest eigenvalue of symmetric matrices.
double greatest_eigenvalue(const Doubles& centre, const Doubles& radius) {
  constexpr double unit = std::numeric_limits<double>::epsilon();
  const auto n = static_cast<double>(centre.rows());
  if (!centre.allFinite() || !radius.allFinite()) return infinite;
  const Doubles Q = Eigen::SelfAdjointEigenSolver<Doubles>(centre).eigenvectors();
  // Q^T S Q is nearly diagonal, and Q^T Q nearly 1. With x = Q y, Gershgorin's circles of both bound x^T S x / x^T x.
  // That holds for any Q that is regular. Sums of n products are off by less than n + 2 roundings of their
  // magnitudes.
  const Doubles sizes = Q.cwiseAbs(), product = centre * Q;
  const Doubles turned = Q.transpose() * product, own = Q.transpose() * Q;
  const Doubles of_turned = sizes.transpose() * (centre.cwiseAbs() * sizes), of_own = sizes.transpose() * sizes;
  double greatest = -infinite, off = 0;
  for (Index i = 0; i < centre.rows(); ++i) {
    double row = turned(i, i), of_unit = std::abs(own(i, i) - 1);
    for (Index j = 0; j < centre.rows(); ++j)
      if (j != i) {
        row += std::abs(turned(i, j));
        of_unit += std::abs(own(i, j));
      }
    greatest = std::max(greatest, row + 4 * (n + 2) * unit * of_turned.row(i).sum());
    off = std::max(off, of_unit + 4 * (n + 2) * unit * of_own.row(i).sum());
  }
  if (!(off < double{1} / 2)) return infinite;
  greatest = greatest > 0 ? greatest / (1 - 2 * off) : greatest / (1 + 2 * off);
  // The spectral norm of what is symmetric is at most its greatest row.
  const double radius_norm = radius.rowwise().sum().maxCoeff() * (1 + 2 * n * unit);
  return greatest + radius_norm + (std::abs(greatest) + radius_norm) * 4 * unit;
}

}  // namespace

double ErrorGrowth::rate(double omega) const {
  const Index m = A.rows();
  const Bounded a = in_double(A), b = in_double(B);
  // The equation of an error in the coordinates omega L^T dq, L^T dv has the symmetric part [[0, C], [C^T, Y]].
  // C = (omega + A^T / omega) / 2, Y = (B + B^T) / 2.
  Doubles centre = Doubles::Zero(2 * m, 2 * m), radius = centre;
  const Doubles unit = Doubles::Identity(m, m) * omega, across = (unit + a.centre.transpose() / omega) / 2;
  centre.topRightCorner(m, m) = across;
  centre.bottomLeftCorner(m, m) = across.transpose();
  centre.bottomRightCorner(m, m) = (b.centre + b.centre.transpose()) / 2;
  constexpr double few = 4 * std::numeric_limits<double>::epsilon();
  const Doubles of_across =
      (a.radius.transpose() / omega / 2 + (unit + a.centre.cwiseAbs().transpose() / omega) * few) * (1 + few);
  radius.topRightCorner(m, m) = of_across;
  radius.bottomLeftCorner(m, m) = of_across.transpose();
  radius.bottomRightCorner(m, m) =
      ((b.radius + b.radius.transpose()) / 2 + (b.centre.cwiseAbs() + b.centre.cwiseAbs().transpose()) * few) *
      (1 + few);
  return greatest_eigenvalue(centre, radius);
}

ErrorGrowthIn::ErrorGrowthIn(const BallProblem& problem) : problem_(problem) {
  BallMatrix L;
  if (!problem.M().factor(L) || !L.invert(L_inverse_))
    throw IntegrationError("the mass matrix cannot be told from one that is not positive definite");
  for (Index j = 0; j < problem.m(); ++j) {
    velocity_reach_.push_back(greatest_magnitude(square_root(problem.W().at(j, j))));
    momentum_reach_.push_back(greatest_magnitude(square_root(problem.M().at(j, j))));
  }
}

RealBall ErrorGrowthIn::length(const std::vector<RealBall>& dq, const std::vector<RealBall>& dv,
                               const RealBall& omega) const {
  RealBall sum;
  const std::vector<RealBall> of_q = problem_.momentum(dq), of_v = problem_.momentum(dv);
  for (std::size_t j = 0; j < dq.size(); ++j) {
    sum += greatest_magnitude(dv[j]) * greatest_magnitude(of_v[j]);
    sum += omega * omega * greatest_magnitude(dq[j]) * greatest_magnitude(of_q[j]);
  }
  return greatest_magnitude(square_root(sum));
}

MatrixAlong ErrorGrowthIn::hessian(const BallForce& force, const std::vector<BallSeries>& q, bool with_rate,
                                   MatrixAlong* rates) const {
  const Index m = problem_.m(), terms = rates != nullptr ? 3 : with_rate ? 2 : 1;
  const std::vector<BallSeries> h = force.hessian.outputs(force.inputs(q), terms);
  MatrixAlong result(m, m, with_rate);
  force.for_each_second([&](std::size_t output, Index row, Index column, const RealBall& weight) {
    if (h[output].length() == 0) return;
    const RealBall rate = h[output][1] * weight;
    result.add(row, column, h[output][0] * weight, rate);
    if (rates != nullptr) rates->add(row, column, rate, h[output][2] * RealBall(2) * weight);
  });
  return result;
}

ErrorGrowthIn::Local ErrorGrowthIn::local(const PathBox& box, bool with_rate) const {
  const Index m = problem_.m(), nu = problem_.nu();
  Local at{MatrixAlong(m, nu, with_rate),
           MatrixAlong(0, 0, false),
           MatrixAlong(nu, 1, with_rate),
           MatrixAlong(m, 1, with_rate),
           as_series(box.q),
           {},
           {}};
  for (Index j = 0; j < m; ++j) {
    at.q[index(j)].set(1, box.v[index(j)]);
    if (with_rate) at.q[index(j)].set(2, box.acceleration[index(j)] / RealBall(2));
  }
  const Index terms = with_rate ? 2 : 1;
  MatrixAlong F(m, 1, with_rate), v(m, 1, with_rate), rhs(nu, 1, with_rate);
  const std::vector<BallSeries> force = problem_.force(at.q, terms);
  for (Index j = 0; j < m; ++j) {
    F.add(j, 0, force[index(j)][0], force[index(j)][1]);
    v.add(j, 0, box.v[index(j)], with_rate ? box.acceleration[index(j)] : RealBall());
  }
  at.acceleration = problem_.W() * F;
  if (nu == 0) return at;
  for (Index a = 0; a < nu; ++a) {
    const BallConstraint& constraint = problem_.constraints()[index(a)];
    for (const BallSlope& slope : problem_.slopes(a, at.q, terms))
      at.G.add(slope.coordinate, a, slope.series[0], slope.series[1]);
    at.bending.emplace_back(constraint.formula ? m : 0, constraint.formula ? m : 0, with_rate);
    if (constraint.formula) {
      // Its derivative along v is one in time, for which the series has one term more.
      at.curvature.push_back(hessian(*constraint.formula, at.q, true, &at.bending.back()));
      if (!with_rate) at.curvature.back().rate = BallMatrix();
    } else {
      MatrixAlong& H = at.curvature.emplace_back(m, m, with_rate);
      for (const auto& [i, j, h] : constraint.second) H.add(i, j, h, RealBall());
    }
    const MatrixAlong bent = v.transposed() * at.curvature.back() * v;
    rhs.add(a, 0, bent.value.at(0, 0), with_rate ? bent.rate.at(0, 0) : RealBall());
  }
  const MatrixAlong GT = at.G.transposed(), gram = GT * (problem_.W() * at.G);
  if (!gram.invert(at.gram_inverse)) throw IntegrationError("the Gram matrix of the constraints may be singular");
  at.lambda = at.gram_inverse * (rhs + GT * at.acceleration);
  at.acceleration = at.acceleration - problem_.W() * (at.G * at.lambda);
  return at;
}

std::vector<RealBall> ErrorGrowthIn::multipliers(const PathBox& box) const {
  const Local at = local(box, false);
  std::vector<RealBall> result;
  for (Index a = 0; a < problem_.nu(); ++a) result.push_back(at.lambda.value.at(a, 0));
  return result;
}

ErrorGrowthIn::Along ErrorGrowthIn::growth(const PathBox& box, bool with_rate) const {
  const Index m = problem_.m(), nu = problem_.nu();
  const Local at = local(box, with_rate);
  MatrixAlong K(m, m, with_rate), C(nu, m, with_rate), D(nu, m, with_rate), v(m, 1, with_rate);
  for (Index j = 0; j < m; ++j) v.add(j, 0, box.v[index(j)], with_rate ? box.acceleration[index(j)] : RealBall());
  for (const BallForce& force : problem_.forces()) K = K + hessian(force, at.q, with_rate);
  const MatrixAlong vT = v.transposed(), aT = at.acceleration.transposed();
  const auto rate_of = [&](const MatrixAlong& x, Index i, Index j) { return with_rate ? x.rate.at(i, j) : RealBall(); };
  for (Index a = 0; a < nu; ++a) {
    const MatrixAlong& H = at.curvature[index(a)];
    const RealBall lambda = at.lambda.value.at(a, 0), of_lambda = rate_of(at.lambda, a, 0);
    MatrixAlong c = aT * H;
    if (problem_.constraints()[index(a)].formula) c = c + vT * at.bending[index(a)];
    const MatrixAlong d = vT * H;
    for (Index j = 0; j < m; ++j) {
      C.add(a, j, c.value.at(0, j), rate_of(c, 0, j));
      D.add(a, j, d.value.at(0, j), rate_of(d, 0, j));
      for (Index i = 0; i < m; ++i)
        if (arb_is_zero(H.value(i, j)) == 0)
          K.add(i, j, -(lambda * H.value.at(i, j)), -(of_lambda * H.value.at(i, j) + lambda * rate_of(H, i, j)));
    }
  }
  MatrixAlong A = K, B(m, m, with_rate);
  if (nu > 0) {
    const MatrixAlong G_R = at.G * at.gram_inverse;
    A = K - G_R * (at.G.transposed() * (problem_.W() * K) + C);
    B = B - G_R * (D + D);
  }
  const BallMatrix right = L_inverse_.transposed();
  return {L_inverse_ * A * right, L_inverse_ * B * right, at.gram_inverse};
}

ErrorGrowth ErrorGrowthIn::operator()(const PathBox& middle, const PathBox& path, const RealBall& times) const {
  const Along at = growth(middle, false), along = growth(path, true);
  RealBall centre;
  arb_get_mid_arb(raw(centre), raw(times));
  const RealBall apart = times - centre;
  const auto moved = [&](BallMatrix x, const BallMatrix& rate) {
    for (Index i = 0; i < x.rows(); ++i)
      for (Index j = 0; j < x.columns(); ++j) x.add(i, j, rate.at(i, j) * apart);
    return x;
  };
  return {moved(at.A.value, along.A.rate), moved(at.B.value, along.B.rate),
          moved(at.gram_inverse.value, along.gram_inverse.rate)};
}

}  // namespace hbvm::core
