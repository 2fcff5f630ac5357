#include "method/perturbation.hpp"

#include <cmath>
#include <utility>

#include "basis/legendre.hpp"
#include "hbvm/error.hpp"
#include "scalar/literal.hpp"

namespace hbvm::core {
namespace {

/// One set of nodes and what hangs on it.
template <Scalar S>
struct Nodes {
  Vector<S>&c, &b;
  Matrix<S>&P, &I, &projection;
};

template <Scalar S>
void change(S& x, const S& relative) {
  if (x == 0) throw InputError("perturbation: the number is 0, which no relative change alters");
  x *= 1 + relative;
}

void check(bool exists) {
  if (!exists) throw InputError("perturbation: the method has no such number");
}

/// The coefficient of c^m in the shifted Legendre polynomial P_l: sqrt(2 l + 1) (-1)^(l + m) C(l, m) C(l + m, m).
template <Scalar S>
S legendre_coefficient(int l, int m) {
  using std::sqrt;
  S value = sqrt(S(2 * l + 1));
  for (int i = 1; i <= m; ++i) value = value * (l - m + i) * (l + i) / (i * i);
  return (l + m) % 2 == 0 ? value : S(-value);
}

/// P^T diag(b), (31).
template <Scalar S>
void set_projection(Nodes<S>& nodes) {
  for (Index i = 0; i < nodes.P.rows(); ++i)
    for (Index j = 0; j < nodes.P.cols(); ++j) nodes.projection(j, i) = nodes.b[i] * nodes.P(i, j);
}

template <Scalar S>
void perturb(Nodes<S> nodes, const Perturbation& p, const S& relative) {
  const Index i = p.i, j = p.j, rows = nodes.P.rows(), columns = nodes.P.cols();
  switch (p.part) {
    case Perturbation::Part::node: {
      check(i < rows);
      change(nodes.c[i], relative);
      const Vector<S> node = nodes.c.segment(i, 1);
      nodes.P.row(i) = legendre_values<S>(node, static_cast<int>(columns));
      nodes.I.row(i) = legendre_integrals<S>(node, static_cast<int>(columns));
      break;
    }
    case Perturbation::Part::weight:
      check(i < rows);
      change(nodes.b[i], relative);
      break;
    case Perturbation::Part::integral:
      check(i < rows && j < columns);
      change(nodes.I(i, j), relative);
      break;
    case Perturbation::Part::legendre: {
      check(i < columns && j <= i);
      const S change_of_coefficient = relative * legendre_coefficient<S>(p.i, p.j);
      for (Index row = 0; row < rows; ++row) {
        S power = change_of_coefficient;
        for (Index n = 0; n < j; ++n) power *= nodes.c[row];
        nodes.P(row, i) += power;
        nodes.I(row, i) += power * nodes.c[row] / (p.j + 1);
      }
      break;
    }
    case Perturbation::Part::X:
      break;
  }
  if (p.part != Perturbation::Part::integral) set_projection(nodes);
}

/// A and what the unknowns of lambda add to lambda(1), from the values and integrals at the constraints' nodes.
template <Scalar S>
void follow(Hbvm<S>& m, const Perturbation& p, const S& relative) {
  using std::sqrt;
  using Part = Perturbation::Part;
  const bool coefficients = m.has_coefficients_of_lambda();
  if (coefficients)
    m.A = m.P_s.lazyProduct(Matrix<S>(m.X_s.lazyProduct(m.projection)));
  else
    m.A = m.I_s.lazyProduct(m.projection);
  if (p.part == Part::integral) return;
  Vector<S> at_1(m.s);
  for (int j = 0; j < m.s; ++j) {
    at_1[j] = sqrt(S(2 * j + 1));
    if (p.part == Part::legendre && p.i == j) at_1[j] += relative * legendre_coefficient<S>(p.i, p.j);
  }
  if (coefficients) {
    m.lambda_at_1 = at_1;
    return;
  }
  for (Index i = 0; i < m.s; ++i) {
    m.lambda_at_1[i] = 0;
    for (Index j = 0; j < m.s; ++j) m.lambda_at_1[i] += at_1[j] * m.projection(j, i);
  }
}

}  // namespace

template <Scalar S>
void perturb(Hbvm<S>& method, const Perturbation& p) {
  using Part = Perturbation::Part;
  check(p.i >= 0 && p.j >= 0);
  // What alters no number of this precision may lie below its least number.
  const S factor = evaluate<S>(Expression::parse("1+(" + p.relative.text() + ")"));
  const S relative = factor == 1 ? S(0) : evaluate<S>(p.relative);
  if (p.part == Part::X) {
    check(p.i < method.s && p.j < method.s);
    change(method.X_s(p.i, p.j), relative);
    if (method.has_coefficients_of_lambda() && relative != 0) follow(method, p, relative);
    return;
  }
  Hbvm<S> m = method;
  const bool both = m.k == m.r || p.part == Part::legendre;
  if (both || p.hat) perturb<S>(Nodes<S>{m.c_hat, m.b_hat, m.P_hat, m.I_hat, m.projection_hat}, p, relative);
  if (both || !p.hat) {
    perturb<S>(Nodes<S>{m.c, m.b, m.P_s, m.I_s, m.projection}, p, relative);
    follow(m, p, relative);
  }
  // Else no number is another, and what follows from it would only be rounded once more.
  if (S(1 + relative) != 1) method = std::move(m);
}

#define HBVM_DEFINE(S) template void perturb<S>(Hbvm<S>&, const Perturbation&);
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
