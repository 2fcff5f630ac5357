#include <algorithm>

#include "laboratory.hpp"
#include "measurements.hpp"
#include "method/order_conditions.hpp"
#include "method/runge_kutta.hpp"
#include "method/symmetry_defect.hpp"
#include "reference/reference_motion.hpp"
#include "scene/assemble.hpp"
#include "step/hbvm_method.hpp"
#include "trial.hpp"

namespace hbvm::core {
namespace {

/// The same numbers in the digits of the scope.
template <Scalar S, int columns>
Eigen::Matrix<Mpfr, Eigen::Dynamic, columns> exact(const Eigen::Matrix<S, Eigen::Dynamic, columns>& a) {
  Eigen::Matrix<Mpfr, Eigen::Dynamic, columns> r(a.rows(), a.cols());
  copy_exactly(r, a);
  return r;
}

Matrix<Mpfr> times(const Matrix<Mpfr>& a, const Matrix<Mpfr>& b) { return a.lazyProduct(b); }

/// Of a method on a scene.
int constraint_nodes(const HbvmMethod& method, const std::string& problem) {
  const PrecisionScope digits(30);  // whose range holds whatever a scene may
  return method.constraint_nodes(assemble<Mpfr>(load_scene(problem)).problem);
}

}  // namespace

template <Scalar S>
std::map<Quantity, double> tableau_defects(const Claim& subject) {
  const HbvmMethod& audited = *as_hbvm(*subject.method);
  const bool of_problem = !subject.problem.empty() && subject.problem != "tableau" && audited.name().r == 0;
  const Hbvm<S> method =
      of_problem ? audited.coefficients<S>(constraint_nodes(audited, subject.problem)) : audited.coefficients<S>();
  // Twice the digits show the rounding of each entry, and nothing of the sums.
  const PrecisionScope scope(2 * static_cast<unsigned>(digits10<S>()) + guard_digits);
  const int k = method.k, s = method.s, r = method.r;
  const Matrix<Mpfr> P = exact<S>(method.P_s), I = exact<S>(method.I_s), X = exact<S>(method.X_s),
                     projection = exact<S>(method.projection);
  const Matrix<Mpfr> A = exact<S>(method.A);
  // Of the r nodes of the constraints; for r = s Gauss's method.
  const RungeKutta<Mpfr> gauss{r == s ? A : times(I, projection), exact<S>(method.b), exact<S>(method.c)};
  const Matrix<Mpfr> I_hat = exact<S>(method.I_hat), projection_hat = exact<S>(method.projection_hat);
  // The k-stage method that HBVM(k, s) is without constraints.
  const RungeKutta<Mpfr> hat{times(I_hat, projection_hat), exact<S>(method.b_hat), exact<S>(method.c_hat)};

  std::map<Quantity, double> result;
  const auto add = [&](Quantity quantity, const Mpfr& defect) {
    const double size = log2_of(defect);
    const auto [place, is_new] = result.try_emplace(quantity, size);
    if (!is_new) place->second = std::max(place->second, size);
  };
  add(Quantity::B, condition_B(gauss, 2 * r));
  add(Quantity::B, condition_B(hat, 2 * k));
  add(Quantity::C, condition_C(gauss, s));
  add(Quantity::C, condition_C(hat, s));
  add(Quantity::D, condition_D(gauss, r == s ? s : s - 1));
  add(Quantity::D, condition_D(hat, k == s ? s : s - 1));
  // Of the integrals X has the coefficients below that of P_s, which vanishes at s nodes.
  if (r == s)
    add(Quantity::X, max_norm(Matrix<Mpfr>(I - times(P, X))));
  else
    add(Quantity::X, max_norm(Matrix<Mpfr>(times(projection, I) - X)));
  add(Quantity::X, max_norm(Matrix<Mpfr>(times(projection, P) - Matrix<Mpfr>::Identity(s, s))));
  add(Quantity::X,
      max_norm(Matrix<Mpfr>(times(projection_hat, exact<S>(method.P_hat)) - Matrix<Mpfr>::Identity(s, s))));
  // gamma = e_1 p_0 + … of (54) takes P_0 for 1.
  for (const Matrix<Mpfr>& values : {P, exact<S>(method.P_hat)})
    for (Index i = 0; i < values.rows(); ++i) add(Quantity::X, abs(Mpfr(values(i, 0) - 1)));
  add(Quantity::W, max_norm(Matrix<Mpfr>(times(times(projection, A), P) - X)));
  for (const RungeKutta<Mpfr>* const part : {&gauss, &hat}) {
    add(Quantity::symmetry, symmetry_defect(*part));
    for (Index i = 0; i < part->c.size(); ++i)
      add(Quantity::symmetry, abs(Mpfr(part->c[i] + part->c[part->c.size() - 1 - i] - 1)));
  }
  return result;
}

#define HBVM_DEFINE(S) template std::map<Quantity, double> tableau_defects<S>(const Claim&);
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core
