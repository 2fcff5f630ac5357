#include "typo.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "method/order_conditions.hpp"
#include "scalar/text.hpp"

namespace hbvm::core {
namespace {

constexpr unsigned scope_digits = 60;
constexpr int last_order = 5;

std::string numbered(const char* name, Index i) { return std::string(name) + "[" + std::to_string(i + 1) + "]"; }

class TypoSearch {
 public:
  TypoSearch(const Tableau& tableau, int order, int digits)
      : method_(make_runge_kutta<Mpfr>(tableau)), order_(order), tolerance_(pow(Mpfr(10), -digits)) {
    const std::vector<Mpfr> next = order_residuals(method_, order + 1).back();
    while (tree_ < next.size() && magnitude(next[tree_]) <= tolerance_) ++tree_;
    is_missed_ = tree_ < next.size();
    residual_ = is_missed_ ? next[tree_] : Mpfr(0);
  }

  std::optional<Typo> find() {
    if (!is_missed_) return std::nullopt;
    const Index s = method_.b.size();
    for (Index i = 0; i < s; ++i) {
      for (Index j = 0; j < s; ++j) look_at(method_.A(i, j), numbered("A", i) + numbered("", j));
      look_at(method_.b[i], numbered("b", i));
    }
    return best_;
  }

 private:
  Mpfr residual() const { return order_residuals(method_, order_ + 1).back()[tree_]; }

  void look_at(Mpfr& entry, const std::string& name) {
    if (entry == 0) return;
    const Mpfr written = entry;
    if (solve(entry)) {
      const Mpfr change = magnitude(Mpfr(entry - written));
      const int order = hbvm::core::order(method_, tolerance_);
      if (conditions_won(order) >= 3 &&
          (!best_ || order > best_->order || (order == best_->order && change < least_change_))) {
        // As many digits as show the difference, and some more.
        const double same =
            -std::log10(std::max(std::abs(approximately(Mpfr(change / written))), std::numeric_limits<double>::min()));
        const int shown = std::clamp(static_cast<int>(same) + 3, 5, 50);
        best_ = Typo{name, to_scientific(written, shown), to_scientific(entry, shown), order};
        least_change_ = change;
      }
    }
    entry = written;
  }

  /// The secant method in this one entry.
  bool solve(Mpfr& entry) const {
    constexpr int rounds = 12;
    Mpfr x = entry, r = residual_;
    entry += max_change(x);
    for (int n = 0; n < rounds; ++n) {
      const Mpfr now = residual();
      if (!is_finite(now) || now == r) return false;
      if (magnitude(now) <= tolerance_ * tolerance_ || magnitude(now) <= 1'000 * epsilon<Mpfr>()) return true;
      const Mpfr next = entry - now * (entry - x) / (now - r);
      x = entry;
      r = now;
      entry = next;
    }
    return false;
  }
  static Mpfr max_change(const Mpfr& x) { return magnitude(x) / 1'024; }

  /// Trees of the orders above the one there is, up to this.
  long conditions_won(int order) const {
    long won = 0;
    for (const RootedTree& tree : rooted_trees(std::min(order, deciding_tree_order))) won += tree.order > order_;
    return won;
  }

  mutable RungeKutta<Mpfr> method_;
  int order_;
  Mpfr tolerance_, residual_ = 0, least_change_ = 0;
  std::size_t tree_ = 0;
  bool is_missed_ = false;
  std::optional<Typo> best_;
};

}  // namespace

std::optional<Typo> typo_of(const Tableau& tableau, int order, int digits) {
  if (order > last_order) return std::nullopt;
  const PrecisionScope scope(scope_digits);
  return TypoSearch(tableau, order, std::min(digits, static_cast<int>(scope_digits) / 2)).find();
}

bool is_nearly_of_next_order(const Tableau& tableau, int order) {
  if (order >= std::min(deciding_tree_order, 2 * static_cast<int>(tableau.b.size()))) return false;
  const PrecisionScope scope(scope_digits);
  Mpfr worst = 0;
  const auto residuals = order_residuals(make_runge_kutta<Mpfr>(tableau), order + 1);
  for (const Mpfr& residual : residuals.back()) raise_to(worst, magnitude(residual));
  Mpfr ways = 100;
  for (int n = 1; n <= order / 2; ++n) ways = ways * (order + 1 - n) / n;
  return worst * ways < 1;
}

}  // namespace hbvm::core
