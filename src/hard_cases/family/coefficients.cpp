#include "basis/gauss_legendre.hpp"
#include "hard_cases/family.hpp"
#include "method/hbvm.hpp"
#include "scalar/with_scalar.hpp"

namespace hbvm::core {
namespace {

using Exact = std::vector<BigFloat>;

template <Scalar S>
void append(Exact& all, const S* x, Index size) {
  for (Index i = 0; i < size; ++i) all.push_back(exactly(x[i]));
}

template <Scalar S>
Exact nodes_in(int n) {
  const Quadrature<S> formula = gauss_legendre<S>(n);
  Exact all;
  append(all, formula.c.data(), formula.c.size());
  append(all, formula.b.data(), formula.b.size());
  return all;
}

template <Scalar S>
Exact coefficients_in(int k, int s) {
  const Hbvm<S> method = make_hbvm<S>(k, s);
  Exact all;
  for (const Vector<S>* const v : {&method.c, &method.b, &method.c_hat, &method.b_hat, &method.lambda_at_1})
    append(all, v->data(), v->size());
  for (const Matrix<S>* const a : {&method.P_s, &method.I_s, &method.P_hat, &method.I_hat, &method.X_s,
                                   &method.projection, &method.projection_hat, &method.A})
    append(all, a->data(), a->size());
  return all;
}

/// The greatest error in units in the last place of the number itself, against 20 more digits. What is 0 in either has
/// the unit of 1: it stands among numbers of that size.
double ulps(const Exact& x, const Exact& more, long bits) {
  double worst = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    BigFloat difference(4 * bits + 256);
    mpfr_sub(raw(difference), raw(x[i]), raw(more[i]), MPFR_RNDN);
    if (mpfr_zero_p(raw(difference)) != 0) continue;
    const bool small = mpfr_zero_p(raw(x[i])) != 0 || mpfr_zero_p(raw(more[i])) != 0;
    const long exponent = small ? 1 : mpfr_get_exp(raw(more[i]));
    mpfr_mul_2si(raw(difference), raw(difference), bits - exponent, MPFR_RNDN);
    raise_to(worst, std::abs(mpfr_get_d(raw(difference), MPFR_RNDN)));
  }
  return worst;
}

template <class F>
CaseResult against_more_digits(const std::string& name, F&& numbers) {
  const Precision precision = Precision::parse(name);
  const Precision more = Precision::parse("mpfr:" + std::to_string(precision.digits() + 20));
  const long bits = with_scalar(precision, []<Scalar S>() { return static_cast<long>(significand_bits<S>()); });
  CaseResult result;
  // Right to the last bit but for guard digits that run out: rounded once, half a unit.
  result.criteria = {
      {"units in the last place", ulps(with_scalar(precision, numbers), with_scalar(more, numbers), bits), 1}};
  return result;
}

}  // namespace

void add_coefficients(const Family& family) {
  for (const int n : {5, 100, 1000})
    family.add("Gauss-Legendre nodes and weights", "n = " + std::to_string(n), all_precisions, holds(),
               [n](const std::string& precision) {
                 return against_more_digits(precision, [n]<Scalar S>() { return nodes_in<S>(n); });
               });
  std::vector<std::pair<int, int>> methods{{12, 12}, {60, 40}};
  if (family.full()) methods.insert(methods.end(), {{200, 200}, {1000, 100}});
  for (const auto& [k, s] : methods)
    family.add("coefficients of HBVM(k,s)", HbvmName{k, s}.text(), all_precisions, holds(),
               [k = k, s = s](const std::string& precision) {
                 return against_more_digits(precision, [k, s]<Scalar S>() { return coefficients_in<S>(k, s); });
               });
}

}  // namespace hbvm::core
