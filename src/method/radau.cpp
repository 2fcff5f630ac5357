#include "method/radau.hpp"

#include "basis/gauss_legendre.hpp"
#include "basis/legendre.hpp"
#include "hbvm/error.hpp"
#include "linear/rounded.hpp"
#include "method/hbvm_name.hpp"
#include "scalar/in_place.hpp"

namespace hbvm::core {
namespace {

/// The step of Newton's iteration for P_s - P_{s-1} at x = 2c - 1.
Mpfr newton_step(const Mpfr& c, int s) {
  const Matrix<Mpfr> row = legendre_values<Mpfr>(Vector<Mpfr>::Constant(1, c), s + 1);
  const auto P = [&](int j) { return j < 0 ? Mpfr(0) : Mpfr(row(0, j) / sqrt(Mpfr(2 * j + 1))); };
  const Mpfr x = 2 * c - 1;
  // (1 - x^2) P_n'(x) = n (P_{n-1} - x P_n)
  const Mpfr slope = (s * (P(s - 1) - x * P(s)) - (s - 1) * (P(s - 2) - x * P(s - 1))) / (1 - x * x);
  return (P(s - 1) - P(s)) / slope / 2;
}

/// The roots, ascending, from the Chebyshev-Radau points.
Vector<Mpfr> radau_nodes(int s) {
  const Mpfr pi = 4 * atan(Mpfr(1));
  // Convergence is quadratic: what follows so small a change is round-off.
  const Mpfr small = ldexp(Mpfr(1), -static_cast<int>(mpfr_working_bits()) * 2 / 3);
  Vector<Mpfr> c(s);
  c[s - 1] = 1;
  for (int i = 1; i < s; ++i) {
    Mpfr& root = c[s - 1 - i];
    root = (1 + cos(2 * pi * i / (2 * s - 1))) / 2;
    Mpfr change;
    do {
      change = newton_step(root, s);
      root += change;
    } while (magnitude(change) > small * root);
  }
  return c;
}

/// In the precision of the scope.
RungeKutta<Mpfr> with_all_digits(int s) {
  RungeKutta<Mpfr> method{Matrix<Mpfr>::Zero(s, s), {}, radau_nodes(s)};
  const Vector<Mpfr>& c = method.c;
  Vector<Mpfr> others = Vector<Mpfr>::Constant(s, Mpfr(1));
  for (Index j = 0; j < s; ++j)
    for (Index k = 0; k < s; ++k)
      if (k != j) others[j] *= c[j] - c[k];
  // A_ij is the integral of the j-th Lagrange polynomial from 0 to c_i, for which half as many nodes do.
  const Quadrature<Mpfr> gauss = gauss_legendre<Mpfr>((s + 1) / 2);
  Vector<Mpfr> after(s + 1);
  for (Index i = 0; i < s; ++i) {
    for (Index m = 0; m < gauss.c.size(); ++m) {
      const Mpfr x = c[i] * gauss.c[m];
      after[s] = 1;
      for (Index j = s; j-- > 0;) after[j] = after[j + 1] * (x - c[j]);
      Mpfr before = c[i] * gauss.b[m];
      for (Index j = 0; j < s; ++j) {
        method.A(i, j) += before * after[j + 1] / others[j];
        before *= x - c[j];
      }
    }
  }
  method.b = method.A.row(s - 1).transpose();
  return method;
}

}  // namespace

template <Scalar S>
RungeKutta<S> radau(int s) {
  if (s < 1 || s > max_s)
    throw InputError("radau:" + std::to_string(s) + ": S must be between 1 and " + std::to_string(max_s));
  const auto digits = static_cast<unsigned>(digits10<S>());
  const PrecisionScope guarded(digits + 20 + static_cast<unsigned>(s));
  const RungeKutta<Mpfr> method = with_all_digits(s);
  const PrecisionScope working(digits);
  return {rounded<S>(method.A), rounded<S>(method.b), rounded<S>(method.c)};
}

#define HBVM_DEFINE(S) template RungeKutta<S> radau<S>(int);
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
