#include "coefficients.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "measurements.hpp"
#include "method/order_conditions.hpp"
#include "method/symmetry_defect.hpp"
#include "reference/reference_motion.hpp"
#include "step/hbvm_method.hpp"
#include "step/tableau_method.hpp"

namespace hbvm::core {
namespace {

/// What the sums of the conditions may lose.
constexpr int guard = 24;

}  // namespace

bool CoefficientCheck::is_for(const Method& method) { return as_hbvm(method) || as_tableau(method); }

CoefficientCheck::CoefficientCheck(const Claim& subject, int digits) : digits_(digits) {
  const PrecisionScope scope(static_cast<unsigned>(digits + guard));
  if (const TableauMethod* const method = as_tableau(*subject.method)) {
    decimals_ = decimals_of(method->tableau());
    // Beyond their own digits decimals show what a few more do.
    constexpr int beyond = 40;
    if (decimals_) digits_ = std::min(digits, decimals_->digits + beyond);
    look_at(method->tableau());
    return;
  }
  definition_ = digits;
  for (const auto& [quantity, defect] : tableau_defects<Mpfr>(subject))
    definition_ = std::min(definition_, decimal_digits(defect));
}

int CoefficientCheck::decimal_digits(double log2_defect) const {
  if (std::isnan(log2_defect)) return 0;
  const double digits = -log2_defect * std::numbers::ln2 / std::numbers::ln10;
  return static_cast<int>(std::clamp<double>(std::floor(digits), 0, digits_));
}

namespace {

/// All defects of one method.
EachCondition<Mpfr> defects_of(const RungeKutta<Mpfr>& method) {
  EachCondition<Mpfr> defects{{}, {}, {}, {}, symplecticity_defect(method), symmetry_defect(method)};
  const int s = method.stages();
  // A condition that is missed is missed by all that need it.
  const auto add = [](std::vector<Mpfr>& all, const Mpfr& own) {
    all.push_back(own);
    if (all.size() > 1) raise_to(all.back(), all[all.size() - 2]);
  };
  for (const Mpfr& defect : order_defects(method, std::min(deciding_tree_order, 2 * s))) add(defects.trees, defect);
  for (int n = 1; n <= 2 * s; ++n) add(defects.B, condition_B(method, n));
  for (int n = 1; n <= s; ++n) {
    add(defects.C, condition_C(method, n));
    add(defects.D, condition_D(method, n));
  }
  return defects;
}

/// f of what is known of each condition.
template <class From, class F>
auto each(const EachCondition<From>& from, const F& f) {
  using To = decltype(f(from.symmetry));
  const auto all = [&](const std::vector<From>& values) {
    std::vector<To> result;
    for (const From& value : values) result.push_back(f(value));
    return result;
  };
  return EachCondition<To>{all(from.trees), all(from.B),           all(from.C),
                           all(from.D),     f(from.symplecticity), f(from.symmetry)};
}

/// Of each condition f(its value in a, that in b).
template <class T, class F>
void with_each(EachCondition<T>& a, const EachCondition<T>& b, const F& f) {
  using Values = std::vector<T> EachCondition<T>::*;
  for (const Values values :
       {&EachCondition<T>::trees, &EachCondition<T>::B, &EachCondition<T>::C, &EachCondition<T>::D})
    for (std::size_t i = 0; i < (a.*values).size(); ++i) f((a.*values)[i], (b.*values)[i]);
  f(a.symplecticity, b.symplecticity);
  f(a.symmetry, b.symmetry);
}

double log2_or_nan(const Mpfr& defect) {
  return is_finite(defect) ? log2_of(defect) : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

void CoefficientCheck::look_at(const Tableau& tableau) {
  const RungeKutta<Mpfr> method = make_runge_kutta<Mpfr>(tableau);
  const EachCondition<Mpfr> own = defects_of(method);
  const auto digits = [&](double log2_defect) { return decimal_digits(log2_defect); };
  seen_ = each(each(own, log2_or_nan), digits);
  // By how much a unit in the last digits changes them, at most.
  EachCondition<double> change = each(own, [](const Mpfr&) { return -std::numeric_limits<double>::infinity(); });
  constexpr unsigned patterns = 4;
  for (unsigned pattern = 1; decimals_ && pattern <= patterns; ++pattern) {
    EachCondition<Mpfr> changed = defects_of(off_by_a_unit(tableau, *decimals_, pattern));
    with_each(changed, own, [](Mpfr& x, const Mpfr& from) { x = abs(Mpfr(x - from)); });
    with_each(change, each(changed, log2_or_nan), [](double& bound, double by) {
      if (!(by <= bound)) bound = by;
    });
  }
  due_ = each(change, digits);
  // What four patterns of signs leave out, and that the digits are whole.
  constexpr int slack = 2;
  if (!decimals_) return;
  for (std::vector<int>* const all : {&due_.trees, &due_.B, &due_.C, &due_.D})
    for (std::size_t i = 0; i < all->size(); ++i)
      (*all)[i] = std::min(std::max(1, (*all)[i] - slack), i > 0 ? (*all)[i - 1] : digits_);
  due_.symplecticity = std::max(1, due_.symplecticity - slack);
  due_.symmetry = std::max(1, due_.symmetry - slack);
}

int CoefficientCheck::order_by_parts(const EachCondition<int>& digits, int p) const {
  const auto at = [](const std::vector<int>& all, int n, int none) {
    return n < 1 ? none : n > static_cast<int>(all.size()) ? 0 : all[static_cast<std::size_t>(n - 1)];
  };
  // B(p), C(q), D(r) with p <= 2 q + 2 and p <= q + r + 1.
  int best = 0;
  for (int q = std::max(0, (p - 1) / 2); q <= static_cast<int>(digits.C.size()); ++q)
    best = std::max(best, std::min(at(digits.C, q, digits_), at(digits.D, p - 1 - q, digits_)));
  return std::min({best, at(digits.B, p, digits_), digits.trees.empty() ? digits_ : digits.trees.back()});
}

Met CoefficientCheck::order(int p) const {
  if (p < 1) return {digits_, digits_};
  if (p <= static_cast<int>(seen_.trees.size())) {
    const auto place = static_cast<std::size_t>(p - 1);
    return {seen_.trees[place], due_.trees[place]};
  }
  if (!decimals_) return {order_by_parts(seen_, p), digits_};
  return {order_by_parts(seen_, p), std::max(1, order_by_parts(due_, p))};
}

int CoefficientCheck::order_to(int digits) const {
  int p = 0;
  while (p < static_cast<int>(seen_.B.size()) && order(p + 1).seen >= digits) ++p;
  return p;
}

int CoefficientCheck::order_found() const {
  int p = 0;
  while (p < static_cast<int>(seen_.B.size()) && order(p + 1).holds()) ++p;
  return p;
}

int CoefficientCheck::found(const std::vector<int>& seen, const std::vector<int>& due) {
  int n = 0;
  while (static_cast<std::size_t>(n) < seen.size() &&
         seen[static_cast<std::size_t>(n)] >= due[static_cast<std::size_t>(n)])
    ++n;
  return n;
}

}  // namespace hbvm::core
