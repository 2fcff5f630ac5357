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

/// All defects of one method, in this sequence: of trees, B, C and D by order or power, symplecticity, symmetry.
struct AllDefects {
  std::vector<Mpfr> trees, B, C, D;
  Mpfr symplecticity, symmetry;

  explicit AllDefects(const RungeKutta<Mpfr>& method)
      : symplecticity(symplecticity_defect(method)), symmetry(symmetry_defect(method)) {
    const int s = method.stages();
    // A condition that is missed is missed by all that need it.
    const auto add = [](std::vector<Mpfr>& all, const Mpfr& own) {
      all.push_back(own);
      if (all.size() > 1) raise_to(all.back(), all[all.size() - 2]);
    };
    for (const Mpfr& defect : order_defects(method, std::min(max_tree_order, 2 * s))) add(trees, defect);
    for (int n = 1; n <= 2 * s; ++n) add(B, condition_B(method, n));
    for (int n = 1; n <= s; ++n) {
      add(C, condition_C(method, n));
      add(D, condition_D(method, n));
    }
  }
};

double log2_or_nan(const Mpfr& defect) {
  return is_finite(defect) ? log2_of(defect) : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

void CoefficientCheck::Defects::raise_by_change(const RungeKutta<Mpfr>& method, const RungeKutta<Mpfr>& other) {
  const AllDefects here(method), there(other);
  const auto raise = [](double& bound, const Mpfr& a, const Mpfr& b) {
    const double change = log2_or_nan(Mpfr(abs(Mpfr(a - b))));
    if (!(change <= bound)) bound = change;
  };
  const auto raise_all = [&](std::vector<double>& bounds, const std::vector<Mpfr>& a, const std::vector<Mpfr>& b) {
    bounds.resize(a.size(), -std::numeric_limits<double>::infinity());
    for (std::size_t i = 0; i < a.size(); ++i) raise(bounds[i], a[i], b[i]);
  };
  raise_all(trees, here.trees, there.trees);
  raise_all(B, here.B, there.B);
  raise_all(C, here.C, there.C);
  raise_all(D, here.D, there.D);
  raise(symplecticity, here.symplecticity, there.symplecticity);
  raise(symmetry, here.symmetry, there.symmetry);
}

CoefficientCheck::Digits CoefficientCheck::digits_of(const Defects& defects) const {
  Digits result;
  const auto all = [&](const std::vector<double>& from, std::vector<int>& to) {
    for (const double defect : from) to.push_back(decimal_digits(defect));
  };
  all(defects.trees, result.trees);
  all(defects.B, result.B);
  all(defects.C, result.C);
  all(defects.D, result.D);
  result.symplecticity = decimal_digits(defects.symplecticity);
  result.symmetry = decimal_digits(defects.symmetry);
  return result;
}

void CoefficientCheck::look_at(const Tableau& tableau) {
  constexpr double none = -std::numeric_limits<double>::infinity();
  const RungeKutta<Mpfr> method = make_runge_kutta<Mpfr>(tableau);
  const AllDefects own(method);
  const auto logs = [](const std::vector<Mpfr>& all) {
    std::vector<double> result;
    for (const Mpfr& x : all) result.push_back(log2_or_nan(x));
    return result;
  };
  const Defects defects{logs(own.trees),          logs(own.B), logs(own.C), logs(own.D), log2_or_nan(own.symplecticity),
                        log2_or_nan(own.symmetry)};
  seen_ = digits_of(defects);
  Defects change{{}, {}, {}, {}, none, none};
  constexpr unsigned patterns = 4;
  if (decimals_)
    for (unsigned pattern = 1; pattern <= patterns; ++pattern)
      change.raise_by_change(method, off_by_a_unit(tableau, *decimals_, pattern));
  else
    change = {std::vector(own.trees.size(), none),
              std::vector(own.B.size(), none),
              std::vector(own.C.size(), none),
              std::vector(own.D.size(), none),
              none,
              none};
  due_ = digits_of(change);
  // What four patterns of signs leave out, and that the digits are whole.
  constexpr int slack = 2;
  if (!decimals_) return;
  for (std::vector<int>* const all : {&due_.trees, &due_.B, &due_.C, &due_.D})
    for (std::size_t i = 0; i < all->size(); ++i)
      (*all)[i] = std::min(std::max(1, (*all)[i] - slack), i > 0 ? (*all)[i - 1] : digits_);
  due_.symplecticity = std::max(1, due_.symplecticity - slack);
  due_.symmetry = std::max(1, due_.symmetry - slack);
}

int CoefficientCheck::order_by_parts(const Digits& digits, int p) const {
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
