#include "hbvm/method/hbvm.hpp"

#include <cmath>

#include "hbvm/basis/gauss_legendre.hpp"
#include "hbvm/basis/legendre.hpp"
#include "hbvm/error.hpp"
#include "linear/rounded.hpp"

namespace hbvm {
namespace {

/// P^T diag(b).
Matrix<Mpfr> projection_of(const Matrix<Mpfr>& P, const Vector<Mpfr>& b) {
  Matrix<Mpfr> r(P.cols(), P.rows());
  for (Index i = 0; i < P.rows(); ++i)
    for (Index j = 0; j < P.cols(); ++j) r(j, i) = b[i] * P(i, j);
  return r;
}

/// The method in the precision of the scope, from nodes of that precision.
Hbvm<Mpfr> assemble(int k, int s) {
  using std::sqrt;
  Hbvm<Mpfr> m;
  m.k = k;
  m.s = s;
  const Quadrature<Mpfr> gauss = gauss_legendre<Mpfr>(s), gauss_hat = gauss_legendre<Mpfr>(k);
  m.c = gauss.c;
  m.b = gauss.b;
  m.c_hat = gauss_hat.c;
  m.b_hat = gauss_hat.b;
  m.P_s = legendre_values<Mpfr>(m.c, s);
  m.I_s = legendre_integrals<Mpfr>(m.c, s);
  m.P_hat = legendre_values<Mpfr>(m.c_hat, s);
  m.I_hat = legendre_integrals<Mpfr>(m.c_hat, s);
  m.X_s = X_matrix<Mpfr>(s);
  m.projection = projection_of(m.P_s, m.b);
  m.projection_hat = projection_of(m.P_hat, m.b_hat);
  m.A = m.I_s.lazyProduct(m.projection);
  m.lagrange_at_1 = Vector<Mpfr>::Zero(s);
  for (int j = 0; j < s; ++j) {
    const Mpfr P_j_at_1 = sqrt(Mpfr(2 * j + 1));
    for (int i = 0; i < s; ++i) m.lagrange_at_1[i] += P_j_at_1 * m.projection(j, i);
  }
  return m;
}

}  // namespace

template <Scalar S>
Hbvm<S> make_hbvm(int k, int s) {
  const HbvmName name{k, s};
  name.check();
  if (name.is_auto()) throw InputError("method " + name.text() + ": K is not chosen yet");
  Hbvm<S> r;
  r.k = k;
  r.s = s;
  const Quadrature<S> gauss = gauss_legendre<S>(s), gauss_hat = gauss_legendre<S>(k);
  r.c = gauss.c;
  r.b = gauss.b;
  r.c_hat = gauss_hat.c;
  r.b_hat = gauss_hat.b;
  // The small integrals near 0 take the most digits.
  const unsigned guard = 20 + static_cast<unsigned>(s);
  const auto digits = static_cast<unsigned>(digits10<S>());
  const PrecisionScope guarded(digits + guard);
  const Hbvm<Mpfr> m = assemble(k, s);
  const PrecisionScope working(digits);
  r.P_s = rounded<S>(m.P_s);
  r.I_s = rounded<S>(m.I_s);
  r.P_hat = rounded<S>(m.P_hat);
  r.I_hat = rounded<S>(m.I_hat);
  r.X_s = rounded<S>(m.X_s);
  r.projection = rounded<S>(m.projection);
  r.projection_hat = rounded<S>(m.projection_hat);
  r.A = rounded<S>(m.A);
  r.lagrange_at_1 = rounded<S>(m.lagrange_at_1);
  return r;
}

#define HBVM_DEFINE(S) template Hbvm<S> make_hbvm<S>(int, int);
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm
