#include "method/hbvm.hpp"

#include <cmath>

#include "basis/gauss_legendre.hpp"
#include "basis/legendre.hpp"
#include "hbvm/error.hpp"
#include "linear/in_double.hpp"
#include "linear/large_product.hpp"
#include "linear/product.hpp"
#include "linear/rounded.hpp"
#include "scalar/in_place.hpp"

namespace hbvm::core {
namespace {

/// P^T diag(b).
Matrix<Mpfr> projection_of(const Matrix<Mpfr>& P, const Vector<Mpfr>& b) {
  Matrix<Mpfr> r(P.cols(), P.rows());
  for (Index i = 0; i < P.rows(); ++i)
    for (Index j = 0; j < P.cols(); ++j) set_product(r(j, i), b[i], P(i, j));
  return r;
}

/// P_j(c_i), j < count, at Gauss nodes: those past 1/2 mirror the others.
Matrix<Mpfr> values_at(const Vector<Mpfr>& c, int count) {
  const Index n = c.size(), half = (n + 1) / 2;
  const Matrix<Mpfr> first = legendre_values<Mpfr>(c.head(half), count);
  Matrix<Mpfr> P(n, count);
  for (Index j = 0; j < count; ++j)
    for (Index i = 0; i < half; ++i) {
      P(i, j) = first(i, j);
      if (j % 2 == 0)
        P(n - 1 - i, j) = P(i, j);
      else if (2 * i + 1 < n)
        set_negative(P(n - 1 - i, j), P(i, j));
    }
  return P;
}

/// Every other column, from the first on.
Matrix<Mpfr> every_other(const Matrix<Mpfr>& a, Index first) {
  Matrix<Mpfr> r(a.rows(), (a.cols() - first + 1) / 2);
  for (Index j = 0; j < r.cols(); ++j)
    for (Index i = 0; i < r.rows(); ++i) set(r(i, j), a(i, first + 2 * j));
  return r;
}

/// I P^T Omega: mirrored nodes have the terms of even and of odd functions in common, but for the sign.
Matrix<Mpfr> butcher_matrix(const Matrix<Mpfr>& I, const Matrix<Mpfr>& projection) {
  const Index s = I.rows(), half = (s + 1) / 2;
  // I_0 = c_i, of which c_i - 1/2 is odd about 1/2; the other I_l are odd for even l.
  const auto sums = [&](Index first) {
    if (first >= s) return Matrix<Mpfr>(Matrix<Mpfr>::Zero(half, half));
    const Matrix<Mpfr> rows = I.topRows(half), columns = projection.leftCols(half).transpose();
    return large_product(every_other(rows, first), every_other(columns, first).transpose());
  };
  const Matrix<Mpfr> even = sums(2), odd = sums(1);
  Matrix<Mpfr> A(s, s);
  Mpfr first;
  for (Index j = 0; j < half; ++j)
    for (Index i = 0; i < half; ++i) {
      set_product(first, projection(0, j), I(i, 0));
      set_sum(A(i, j), first, even(i, j));
      set_difference(A(i, s - 1 - j), A(i, j), odd(i, j));
      set_sum(A(i, j), A(i, j), odd(i, j));
      set_product(first, projection(0, j), I(s - 1 - i, 0));
      set_difference(A(s - 1 - i, j), first, even(i, j));
      set_difference(A(s - 1 - i, s - 1 - j), A(s - 1 - i, j), odd(i, j));
      set_sum(A(s - 1 - i, j), A(s - 1 - i, j), odd(i, j));
    }
  return A;
}

/// The method in the precision of the scope, from nodes of that precision.
Hbvm<Mpfr> assemble(int k, int s, int r) {
  using std::sqrt;
  Hbvm<Mpfr> m;
  m.k = k;
  m.s = s;
  m.r = r;
  const auto at_nodes = [&](int n, Vector<Mpfr>& c, Vector<Mpfr>& b, Matrix<Mpfr>& P, Matrix<Mpfr>& I,
                            Matrix<Mpfr>& projection) {
    const Quadrature<Mpfr> gauss = gauss_legendre<Mpfr>(n);
    c = gauss.c;
    b = gauss.b;
    const Matrix<Mpfr> values = values_at(c, s + 1);
    P = values.leftCols(s);
    I = legendre_integrals<Mpfr>(values);
    projection = projection_of(P, b);
  };
  at_nodes(r, m.c, m.b, m.P_s, m.I_s, m.projection);
  if (k == r) {
    m.c_hat = m.c;
    m.b_hat = m.b;
    m.P_hat = m.P_s;
    m.I_hat = m.I_s;
    m.projection_hat = m.projection;
  } else {
    at_nodes(k, m.c_hat, m.b_hat, m.P_hat, m.I_hat, m.projection_hat);
  }
  m.X_s = X_matrix<Mpfr>(s);
  m.lambda_at_1 = Vector<Mpfr>::Zero(s);
  Mpfr t;
  for (int j = 0; j < s; ++j) {
    const Mpfr P_j_at_1 = sqrt(Mpfr(2 * j + 1));
    if (r > s)
      m.lambda_at_1[j] = P_j_at_1;
    else
      for (int i = 0; i < s; ++i) add_product(m.lambda_at_1[i], P_j_at_1, m.projection(j, i), t);
  }
  if (r == s) {
    m.A = butcher_matrix(m.I_s, m.projection);
  } else {
    Matrix<Mpfr> X_projection;
    product<Mpfr>(X_projection, m.X_s, m.projection);
    product<Mpfr>(m.A, m.P_s, X_projection);
  }
  return m;
}

/// The method with f of each array.
template <Scalar T, Scalar S, class F>
Hbvm<T> converted(const Hbvm<S>& m, const F& f) {
  return {
      m.k,      m.s,        m.r,        f(m.c),   f(m.b),          f(m.c_hat),          f(m.b_hat), f(m.P_s),
      f(m.I_s), f(m.P_hat), f(m.I_hat), f(m.X_s), f(m.projection), f(m.projection_hat), f(m.A),     f(m.lambda_at_1)};
}

}  // namespace

template <Scalar S>
Hbvm<S> make_hbvm(int k, int s, int r) {
  const HbvmName name{k, s, r};
  name.check();
  if (name.is_auto()) throw InputError("method " + name.text() + ": K is not chosen yet");
  const Quadrature<S> gauss = gauss_legendre<S>(r), gauss_hat = k == r ? gauss : gauss_legendre<S>(k);
  // The small integrals near 0 take the most digits.
  const unsigned guard = 20 + static_cast<unsigned>(s);
  const auto digits = static_cast<unsigned>(digits10<S>());
  const PrecisionScope guarded(digits + guard);
  const Hbvm<Mpfr> m = assemble(k, s, r);
  const PrecisionScope working(digits);
  Hbvm<S> method = converted<S>(m, [](const auto& a) { return rounded<S>(a); });
  method.c = gauss.c;
  method.b = gauss.b;
  method.c_hat = gauss_hat.c;
  method.b_hat = gauss_hat.b;
  return method;
}

template <Scalar S>
Hbvm<double> in_double(const Hbvm<S>& method) {
  return converted<double>(method, [](const auto& a) { return in_double(a); });
}

#define HBVM_DEFINE(S)                          \
  template Hbvm<S> make_hbvm<S>(int, int, int); \
  template Hbvm<double> in_double<S>(const Hbvm<S>&);
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
