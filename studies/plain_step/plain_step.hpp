#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <unsupported/Eigen/KroneckerProduct>

/// One step of HBVM(k,s), written as the paper writes it: its symbols, and the numbers of its equations in brackets
/// (arXiv 2203.03275; ../equations.md lists them). It says what is computed, and does nothing to be fast.
namespace plain {

template <class S>
using Vector = Eigen::Matrix<S, Eigen::Dynamic, 1>;
template <class S>
using Matrix = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;

/// q' = M^-1 p, p' = grad U(q) - grad g(q) lambda, g(q) = 0, (5); m coordinates, nu constraints.
template <class S>
struct Mechanics {
  int m, nu;
  Matrix<S> inverse_mass;                               ///< M^-1, m x m
  std::function<Vector<S>(const Vector<S>& q)> grad_U;  ///< m
  std::function<Matrix<S>(const Vector<S>& q)> grad_g;  ///< m x nu
};

template <class S>
struct State {
  Vector<S> q, p, lambda;
};

/// P_0(x) .. P_n(x): the Legendre polynomials that are orthonormal on [0, 1], (18).
template <class S>
Vector<S> legendre(int n, const S& x) {
  using std::sqrt;
  Vector<S> P(n + 1);
  S L = 1, before = 0;  // the common Legendre polynomials in 2x - 1, which are 1 at x = 1
  for (int j = 0; j <= n; ++j) {
    P[j] = sqrt(S(2 * j + 1)) * L;
    const S next = ((2 * j + 1) * (2 * x - 1) * L - j * before) / (j + 1);
    before = L;
    L = next;
  }
  return P;
}

/// P, I and Omega of (27) at n Gauss-Legendre nodes c_i with weights b_i, for s polynomials; of (53) for k nodes.
template <class S>
struct Nodes {
  int n;
  Matrix<S> P, I, Omega;  ///< P(i, j) = P_j(c_i), I(i, j) = int_0^{c_i} P_j, Omega = diag(b)

  Nodes(int count, int s) : n(count), P(n, s), I(n, s), Omega(Matrix<S>::Zero(n, n)) {
    using std::abs, std::sqrt;
    for (int i = 0; i < n; ++i) {
      S c = S((1 - std::cos(std::acos(-1.0) * (i + 0.75) / (n + 0.5))) / 2), change = 1, before;  // near node i
      do {  // Newton's iteration for P_n(c) = 0, as long as the changes of c fall
        const Vector<S> L = legendre(n, c).cwiseQuotient(legendre(n, S(1)));
        before = change;
        change = 2 * c * (1 - c) * L[n] / (n * (L[n - 1] - (2 * c - 1) * L[n]));
        c -= change;
      } while (2 * abs(change) < abs(before));
      const Vector<S> at = legendre(std::max(n, s), c);
      Omega(i, i) = 1 / at.head(n).squaredNorm();
      P.row(i) = at.head(s);
      I(i, 0) = c;
      for (int j = 1; j < s; ++j)
        I(i, j) = (at[j + 1] / sqrt(S(2 * j + 3)) - at[j - 1] / sqrt(S(2 * j - 1))) / (2 * sqrt(S(2 * j + 1)));
    }
  }
};

/// Steps of length h. As in (28) vectors have blocks: gamma, psi and zeta s blocks of m numbers, lambda of nu numbers.
/// The paper has quadratic constraints, and r = s nodes for them. For others take r > s: then lambda and v are the
/// polynomials of degree s - 1 with these Legendre coefficients, and s coefficients of the hidden constraints vanish.
template <class S>
struct Step {
  Step(const Mechanics<S>& mechanics, int k, int s, int r, const S& step)
      : f(mechanics), h(step), nodes(r, s), hat(k, s) {
    const auto kron = [](const Matrix<S>& A, const Matrix<S>& B) { return Eigen::kroneckerProduct(A, B).eval(); };
    const Matrix<S> project = nodes.P.transpose() * nodes.Omega, one = Matrix<S>::Identity(f.m, f.m);
    hI_M = kron(h * nodes.I, f.inverse_mass);
    hIhat_M = kron(h * hat.I, f.inverse_mass);
    hI = kron(h * nodes.I, one);
    PO = kron(project, one);
    POhat = kron(hat.P.transpose() * hat.Omega, one);
    const Matrix<S> same = Matrix<S>::Identity(s, s), one_nu = Matrix<S>::Identity(f.nu, f.nu);
    M = kron(r == s ? same : nodes.P * project, f.inverse_mass);  // v by its coefficients, (25)
    to_nodes = kron(r == s ? same : nodes.P, one_nu);
    from_nodes = kron(r == s ? same : project, one_nu);
    const Vector<S> P_at_1 = legendre(s - 1, S(1));  // l_i(1) = b_i sum_j P_j(c_i) P_j(1)
    at_1 = kron((r == s ? Vector<S>(nodes.Omega * nodes.P * P_at_1) : P_at_1).transpose(), one_nu);
  }
  /// (48): u at the nodes c_i and c_hat_i from gamma, and v at c_i.
  Vector<S> u(const Vector<S>& q0, const Vector<S>& of_v) const { return q0.replicate(nodes.n, 1) + hI_M * of_v; }
  Vector<S> u_hat(const Vector<S>& q0, const Vector<S>& of_v) const { return q0.replicate(hat.n, 1) + hIhat_M * of_v; }
  Vector<S> v(const Vector<S>& p0, const Vector<S>& psi, const Vector<S>& zeta) const {
    return p0.replicate(nodes.n, 1) + hI * (psi - zeta);
  }
  /// (27): the matrix with the blocks grad g(u(c_i h)) in its diagonal.
  Matrix<S> grad_g(const Vector<S>& u) const {
    Matrix<S> G = Matrix<S>::Zero(nodes.n * f.m, nodes.n * f.nu);
    for (int i = 0; i < nodes.n; ++i) G.block(i * f.m, i * f.nu, f.m, f.nu) = f.grad_g(u.segment(i * f.m, f.m));
    return G;
  }
  /// (52): what v leaves of the hidden constraints, grad g^T M^-1 v.
  Vector<S> hidden(const Matrix<S>& G, const Vector<S>& v) const { return from_nodes * (G.transpose() * (M * v)); }
  /// (29): grad g^T (h I P^T Omega ⊗ M^-1) grad g lambda = grad g^T (e ⊗ M^-1 p0 + h I ⊗ M^-1 psi).
  Vector<S> multipliers(const Matrix<S>& G, const Vector<S>& p0, const Vector<S>& psi) const {
    const Matrix<S> matrix = from_nodes * (G.transpose() * (M * (hI * (PO * (G * to_nodes)))));
    return matrix.partialPivLu().solve(hidden(G, v(p0, psi, Vector<S>::Zero(psi.size()))));
  }
  /// (49): zeta = P^T Omega ⊗ 1 grad g lambda.
  Vector<S> pulls(const Matrix<S>& G, const Vector<S>& lambda) const { return PO * (G * (to_nodes * lambda)); }
  /// (50): psi_hat = P_hat^T Omega_hat ⊗ 1 grad U(u_hat).
  Vector<S> forces(const Vector<S>& u_hat) const {
    Vector<S> force(u_hat.size());
    for (int i = 0; i < hat.n; ++i) force.segment(i * f.m, f.m) = f.grad_U(u_hat.segment(i * f.m, f.m));
    return POhat * force;
  }
  /// (54): gamma = P^T Omega ⊗ 1 v.
  Vector<S> momenta(const Vector<S>& v) const { return PO * v; }
  /// q1 and p1 (56) and lambda (57) from the gamma that solves (54), found by the iteration (55).
  State<S> operator()(const State<S>& from) const {
    Vector<S> gamma = Vector<S>::Zero(PO.rows()), psi = gamma, zeta, lambda;
    S least = 0;
    for (int sweep = 1, waiting = 0; waiting < 4; ++sweep) {  // until the changes of gamma are rounding
      const Matrix<S> G = grad_g(u(from.q, gamma));
      lambda = multipliers(G, from.p, psi);
      zeta = pulls(G, lambda);
      const Vector<S> next = momenta(v(from.p, psi, zeta));
      psi = forces(u_hat(from.q, gamma));
      const S change = (next - gamma).cwiseAbs().maxCoeff();
      gamma = next;
      waiting = sweep == 1 || change < least ? 0 : waiting + 1;
      if (waiting == 0) least = change;
    }
    if (!((1 << 20) * least < gamma.cwiseAbs().maxCoeff())) throw std::runtime_error("iteration (55) diverges");
    const Vector<S> q = from.q + h * f.inverse_mass * gamma.head(f.m), p = from.p + h * (psi - zeta).head(f.m);
    return {q, p, at_1 * lambda};
  }

  Mechanics<S> f;
  S h;
  Nodes<S> nodes, hat;  // c_i and c_hat_i
  // In this order: h I ⊗ M^-1, h I_hat ⊗ M^-1, h I ⊗ 1, P^T Omega ⊗ 1, P_hat^T Omega_hat ⊗ 1, 1 ⊗ M^-1.
  Matrix<S> hI_M, hIhat_M, hI, PO, POhat, M, to_nodes, from_nodes, at_1;
};

}  // namespace plain
