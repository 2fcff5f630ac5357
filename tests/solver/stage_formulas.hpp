#pragma once

#include "basis/gauss_legendre.hpp"
#include "solver/stage_equations.hpp"
#include "verification/models.hpp"

namespace hbvm {

/// The stage equations (dispro1) of a dense model as the paper prints them, from monomials instead of recurrences.
class StageFormulas {
 public:
  using Vec = Vector<Mpfr>;
  using Mat = Matrix<Mpfr>;

  StageFormulas(const DenseModel& model, int k, int s, const Mpfr& h)
      : model_(model),
        s_(s),
        h_(h),
        nodes_(gauss_legendre<Mpfr>(s)),
        hat_(gauss_legendre<Mpfr>(k)),
        P_(values(nodes_.c, 0)),
        I_(values(nodes_.c, 1)),
        P_hat_(values(hat_.c, 0)),
        I_hat_(values(hat_.c, 1)) {}

  /// P_j(x), or its integral from 0 to x, from sqrt(2j + 1) sum_l (-1)^(j + l) binom(j, l) binom(j + l, l) x^l.
  static Mpfr legendre(int j, int integrals, const Mpfr& x) {
    Mpfr sum = 0, coefficient = j % 2 == 0 ? 1 : -1, power = 1;
    for (int l = 0; l <= j; ++l) {
      sum += integrals == 0 ? Mpfr(coefficient * power) : Mpfr(coefficient * power * x / (l + 1));
      coefficient *= Mpfr(-(j - l) * (j + l + 1)) / ((l + 1) * (l + 1));
      power *= x;
    }
    return sum * sqrt(Mpfr(2 * j + 1));
  }

  Mat positions(const Vec& q0, const Mat& gamma) const { return positions(q0, gamma, I_); }

  Mat psi(const Vec& q0, const Mat& gamma) const {
    const Mat u = positions(q0, gamma, I_hat_);
    Mat result = Mat::Zero(s_, model_.m());
    for (Index i = 0; i < u.rows(); ++i)
      result += (P_hat_.row(i).transpose() * hat_.b[i]) * model_.force(Vec(u.row(i).transpose())).transpose();
    return result;
  }

  Mat zeta(const Vec& q0, const Mat& gamma, const Mat& lambda) const {
    const Mat u = positions(q0, gamma);
    Mat result = Mat::Zero(s_, model_.m());
    for (Index i = 0; i < s_; ++i) {
      const Vec pull = model_.gradient(Vec(u.row(i).transpose())) * Vec(lambda.row(i).transpose());
      result += (P_.row(i).transpose() * nodes_.b[i]) * pull.transpose();
    }
    return result;
  }

  /// v(c_i), by its coefficients, and by (dispro1).
  Mat velocities(const Mat& gamma) const { return P_ * gamma; }
  Mat velocities(const Vec& p0, const Mat& psi, const Mat& zeta) const {
    Mat v = I_ * Mat(psi - zeta) * h_;
    for (Index i = 0; i < s_; ++i) v.row(i) += p0.transpose();
    return v;
  }

  /// grad g(u(c_i))^T M^-1 v(c_i), s x nu.
  Mat hidden(const Vec& q0, const Mat& gamma, const Mat& v) const {
    const Mat u = positions(q0, gamma);
    Mat result(s_, model_.nu());
    for (Index i = 0; i < s_; ++i)
      result.row(i) = model_.hidden(Vec(u.row(i).transpose()), Vec(v.row(i).transpose())).transpose();
    return result;
  }

  struct Step {
    Vec q, p, lambda;
  };
  /// (q1p1new) and (lagmul).
  Step step(const Vec& q0, const Vec& p0, const StageUnknowns<Mpfr>& x) const {
    Step result;
    result.q = q0 + model_.W * Vec(x.gamma.row(0).transpose()) * h_;
    result.p = p0 + Vec((x.psi - x.zeta).row(0).transpose()) * h_;
    result.lambda = Vec::Zero(model_.nu());
    for (Index i = 0; i < s_; ++i) {
      Mpfr weight = 1;
      for (Index j = 0; j < s_; ++j)
        if (j != i) weight *= (1 - nodes_.c[j]) / (nodes_.c[i] - nodes_.c[j]);
      result.lambda += Vec(x.lambda.row(i).transpose()) * weight;
    }
    return result;
  }

 private:
  Mat values(const Vec& c, int integrals) const {
    Mat result(c.size(), s_);
    for (Index i = 0; i < c.size(); ++i)
      for (int j = 0; j < s_; ++j) result(i, j) = legendre(j, integrals, c[i]);
    return result;
  }
  Mat positions(const Vec& q0, const Mat& gamma, const Mat& integrals) const {
    Mat u = integrals * gamma * model_.W * h_;  // W is symmetric
    for (Index i = 0; i < u.rows(); ++i) u.row(i) += q0.transpose();
    return u;
  }

  const DenseModel& model_;
  int s_;
  Mpfr h_;
  Quadrature<Mpfr> nodes_, hat_;
  Mat P_, I_, P_hat_, I_hat_;
};

}  // namespace hbvm
