#include "coefficients.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hbvm/method/order_conditions.hpp"
#include "hbvm/method/symmetry_defect.hpp"
#include "hbvm/reference/reference_motion.hpp"
#include "hbvm/step/hbvm_method.hpp"
#include "hbvm/step/tableau_method.hpp"
#include "measurements.hpp"

namespace hbvm {
namespace {

/// What the sums of the conditions may lose.
constexpr int guard = 24;

}  // namespace

bool CoefficientCheck::is_for(const Method& method) { return as_hbvm(method) || as_tableau(method); }

CoefficientCheck::CoefficientCheck(const Claim& subject, int digits) : digits_(digits) {
  const PrecisionScope scope(static_cast<unsigned>(digits + guard));
  if (const TableauMethod* const method = as_tableau(*subject.method)) {
    look_at(method->tableau());
    return;
  }
  definition_ = digits;
  for (const auto& [quantity, defect] : tableau_defects<Mpfr>(subject))
    definition_ = std::min(definition_, decimals(defect));
}

int CoefficientCheck::decimals(double log2_defect) const {
  const double digits = -log2_defect * std::numbers::ln2 / std::numbers::ln10;
  return static_cast<int>(std::clamp<double>(std::floor(digits), 0, digits_));
}

void CoefficientCheck::look_at(const Tableau& tableau) {
  const RungeKutta<Mpfr> method = make_runge_kutta<Mpfr>(tableau);
  const auto digits_of = [&](const Mpfr& defect) { return is_finite(defect) ? decimals(log2_of(defect)) : 0; };
  // A condition that is missed is missed by all that need it.
  const auto add = [&](std::vector<int>& all, int own) {
    all.push_back(all.empty() ? own : std::min(own, all.back()));
  };
  const int s = method.stages();
  for (const Mpfr& defect : order_defects(method, std::min(max_tree_order, 2 * s))) add(trees_, digits_of(defect));
  for (int n = 1; n <= 2 * s; ++n) add(B_, digits_of(condition_B(method, n)));
  for (int n = 1; n <= s; ++n) {
    add(C_, digits_of(condition_C(method, n)));
    add(D_, digits_of(condition_D(method, n)));
  }
  symplecticity_ = digits_of(symplecticity_defect(method));
  symmetry_ = digits_of(symmetry_defect(method));
}

int CoefficientCheck::order(int p) const {
  const auto at = [](const std::vector<int>& all, int n, int none) {
    return n < 1 ? none : n > static_cast<int>(all.size()) ? 0 : all[static_cast<std::size_t>(n - 1)];
  };
  if (p <= static_cast<int>(trees_.size())) return at(trees_, p, digits_);
  // B(p), C(q), D(r) with p <= 2 q + 2 and p <= q + r + 1.
  int best = 0;
  for (int q = std::max(0, (p - 1) / 2); q <= static_cast<int>(C_.size()); ++q)
    best = std::max(best, std::min(at(C_, q, digits_), at(D_, p - 1 - q, digits_)));
  return std::min({best, at(B_, p, digits_), trees_.empty() ? digits_ : trees_.back()});
}

int CoefficientCheck::order_to(int digits) const {
  int p = 0;
  while (p < static_cast<int>(B_.size()) && order(p + 1) >= digits) ++p;
  return p;
}

}  // namespace hbvm
