#include "plain_step.hpp"

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/eigen.hpp>
#include <iostream>

namespace {

using plain::Matrix, plain::Vector;

/// Masses 2 and 1 on rods of 1 and 1/2 in the plane, q = (x1, y1, x2, y2), under gravity; a charge at `c` repels the
/// second.
template <class S>
struct DoublePendulum {
  const Vector<S> mass{{2, 2, 1, 1}}, weight{{0, -2, 0, -1}}, c{{2, 0}};

  S U(const Vector<S>& q) const { return weight.dot(q) - 1 / (q.tail(2) - c).norm(); }
  Vector<S> grad_U(const Vector<S>& q) const {
    const Vector<S> d = q.tail(2) - c;
    Vector<S> force = weight;
    force.tail(2) += d / (d.squaredNorm() * d.norm());
    return force;
  }
  Vector<S> g(const Vector<S>& q) const {
    return Vector<S>{{q.head(2).squaredNorm() - 1, (q.tail(2) - q.head(2)).squaredNorm() - S(1) / 4}};
  }
  Matrix<S> grad_g(const Vector<S>& q) const {
    Matrix<S> gradient = Matrix<S>::Zero(4, 2);
    gradient.col(0).head(2) = 2 * q.head(2);
    gradient.col(1).tail(2) = 2 * (q.tail(2) - q.head(2));
    gradient.col(1).head(2) = -gradient.col(1).tail(2);
    return gradient;
  }
  /// (1), and the hidden constraints (9).
  S H(const plain::State<S>& y) const { return y.p.dot(y.p.cwiseQuotient(mass)) / 2 - U(y.q); }
  Vector<S> hidden(const plain::State<S>& y) const { return grad_g(y.q).transpose() * y.p.cwiseQuotient(mass); }
};

template <class S>
void integrate(const char* precision, int k, int s) {
  const DoublePendulum<S> pendulum;
  const plain::Mechanics<S> mechanics{4, 2, pendulum.mass.cwiseInverse().asDiagonal(),
                                      [&](const Vector<S>& q) { return pendulum.grad_U(q); },
                                      [&](const Vector<S>& q) { return pendulum.grad_g(q); }};
  const plain::Step<S> step(mechanics, k, s, s, S(1) / 16);
  // Both rods are level, and the second begins to fall.
  plain::State<S> y{Vector<S>{{1, 0, S(3) / 2, 0}}, Vector<S>{{0, 0, 0, -1}}, Vector<S>::Zero(2)};
  const S H = pendulum.H(y);
  S e_H = 0, e_g = 0, e_hidden = 0;
  for (int n = 0; n < 32; ++n) {
    y = step(y);
    e_H = std::max<S>(e_H, abs(S(pendulum.H(y) - H)));
    e_g = std::max<S>(e_g, pendulum.g(y.q).cwiseAbs().maxCoeff());
    e_hidden = std::max<S>(e_hidden, pendulum.hidden(y).cwiseAbs().maxCoeff());
  }
  std::cout.precision(3);
  std::cout << "HBVM(" << k << ',' << s << ") in " << precision << ": H is off by " << e_H << ", g by " << e_g
            << ", the hidden constraints by " << e_hidden << '\n';
}

}  // namespace

int main() {
  for (const int k : {1, 2, 4}) integrate<double>("double", k, 1);
  for (const int k : {2, 4, 8, 16, 32}) integrate<boost::multiprecision::cpp_bin_float_50>("50 digits", k, 2);
}
