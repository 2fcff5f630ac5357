#include "ball_method.hpp"

namespace hbvm::core {
namespace {

/// P_j(1), the norm of Legendre's own polynomial j.
RealBall norm(int j) { return square_root(RealBall(2 * j + 1)); }

/// P_j and their integrals from 0 at a node, j < s, into row i. x = 2c - 1.
void set_rows(Index i, int s, const RealBall& x, BallMatrix& P, BallMatrix& I) {
  std::vector<RealBall> legendre{1, x};
  for (int j = 1; j < s; ++j) {
    const auto at = static_cast<std::size_t>(j);
    legendre.push_back((RealBall(2 * j + 1) * x * legendre[at] - RealBall(j) * legendre[at - 1]) / RealBall(j + 1));
  }
  I.set(i, 0, (x + RealBall(1)) / RealBall(2));
  for (int j = 0; j < s; ++j) {
    const auto at = static_cast<std::size_t>(j);
    P.set(i, j, norm(j) * legendre[at]);
    // The derivative of L_{j+1} - L_{j-1} is (2j + 1) L_j, and both ends of it vanish at -1.
    if (j > 0) I.set(i, j, (legendre[at + 1] - legendre[at - 1]) / (RealBall(2) * norm(j)));
  }
}

void set_nodes(int n, int s, std::vector<RealBall>& b, BallMatrix& P, BallMatrix& I) {
  P = BallMatrix(n, s);
  I = BallMatrix(n, s);
  for (int i = 0; i < n; ++i) {
    RealBall x, weight;
    // Arb counts the roots from the greatest.
    arb_hypgeom_legendre_p_ui_root(raw(x), raw(weight), static_cast<ulong>(n), static_cast<ulong>(n - 1 - i),
                                   BallScope::bits());
    b.push_back(weight / RealBall(2));
    set_rows(i, s, x, P, I);
  }
}

/// X_s of (32).
BallMatrix tridiagonal(int s) {
  BallMatrix X(s, s);
  X.set(0, 0, RealBall(1) / RealBall(2));
  for (int j = 1; j < s; ++j) {
    const RealBall xi = RealBall(1) / (RealBall(2) * square_root(RealBall(4 * j * j - 1)));
    X.set(j, j - 1, xi);
    X.set(j - 1, j, -xi);
  }
  return X;
}

}  // namespace

BallMethod make_ball_method(int k, int s, int r) {
  BallMethod method;
  method.k = k;
  method.s = s;
  method.r = r;
  set_nodes(r, s, method.b, method.P, method.I);
  set_nodes(k, s, method.b_hat, method.P_hat, method.I_hat);
  method.X = tridiagonal(s);
  for (int i = 0; i < s; ++i) {
    RealBall at_1 = norm(i);
    if (r == s) {
      at_1 = RealBall();
      for (int j = 0; j < s; ++j) at_1 += norm(j) * method.P.at(i, j) * method.b[static_cast<std::size_t>(i)];
    }
    method.lambda_at_1.push_back(at_1);
  }
  return method;
}

}  // namespace hbvm::core
