#include "scheme/repair.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <optional>

#include "interruption.hpp"
#include "scalar/scalar.hpp"
#include "scalar/text.hpp"
#include "scheme/exact_form.hpp"

namespace hbvm::core {
namespace {

using Places = std::vector<std::size_t>;

class RepairSearch {
 public:
  RepairSearch(const Scheme& scheme, const Rounding& rounding, const std::vector<int>& targets)
      : scheme_(scheme),
        rounding_(rounding),
        targets_(targets),
        first_targets_(targets),
        written_(scheme.written_values<double>()),
        exact_(scheme.written_values<Mpfr>()) {
    for (std::size_t e = 0; e < written_.size(); ++e) {
      if (!scheme.entries()[e].written)
        unknown_.push_back(e);
      else if (written_[e] != 0)
        candidates_.push_back(e);
    }
    conditions_ = static_cast<long>(residuals(written_).size());
    // Pairs are many. Those that cannot meet the conditions of low orders, where they fail, need no others.
    constexpr int low = 4;
    for (int& target : first_targets_) target = std::min(target, low);
    if (norm(residuals_to(first_targets_, written_)) <= enough() || first_targets_ == targets_) first_targets_.clear();
  }

  Repair find(int most_entries) {
    Repair repair;
    repair.conditions = conditions_;
    if (!unknown_.empty()) add(repair, unknown_);
    for (int more = 1; more <= most_entries && repair.ways.empty(); ++more) {
      if (more == 1)
        for (const std::size_t e : candidates_) add(repair, with({e}));
      else
        for (std::size_t i = 0; i < candidates_.size(); ++i)
          for (std::size_t j = 0; j < i; ++j)
            if (const Places pair = with({candidates_[j], candidates_[i]}); may_meet(pair)) add(repair, pair);
    }
    return repair;
  }

 private:
  Places with(std::initializer_list<std::size_t> more) const {
    Places all = unknown_;
    all.insert(all.end(), more);
    return all;
  }

  template <class S>
  std::vector<S> residuals(const std::vector<S>& values) const {
    return residuals_to(targets_, values);
  }

  template <class S>
  std::vector<S> residuals_to(const std::vector<int>& targets, const std::vector<S>& values) const {
    std::vector<S> all = scheme_.consistency(values);
    for (std::size_t part = 0; part < targets.size(); ++part)
      for (int order = 1; order <= targets[part]; ++order)
        for (S& residual : scheme_.residuals(part, order, values)) all.push_back(std::move(residual));
    return all;
  }

  template <class S>
  static S norm(const std::vector<S>& residuals) {
    S most = 0;
    for (const S& r : residuals) raise_to(most, magnitude(r));
    return most;
  }

  /// Of an entry in double, from which a derivative has half the digits.
  static double difference() { return 8 * std::sqrt(epsilon<double>()); }

  /// One step of Gauss and Newton in these entries, by differences of size `delta`. \return the rank of the Jacobian
  template <class S>
  Index newton(const std::vector<int>& targets, std::vector<S>& values, const std::vector<S>& now, const Places& places,
               const S& delta) const {
    const auto n = static_cast<Index>(now.size());
    Eigen::MatrixXd jacobian(n, static_cast<Index>(places.size()));
    Eigen::VectorXd off(n);
    const S size = norm(now);
    for (Index r = 0; r < n; ++r) off[r] = size == 0 ? 0 : approximately(S(now[static_cast<std::size_t>(r)] / size));
    for (std::size_t k = 0; k < places.size(); ++k) {
      std::vector<S> moved = values;
      moved[places[k]] += delta;
      const std::vector<S> there = residuals_to(targets, moved);
      for (Index r = 0; r < n; ++r) {
        const auto at = static_cast<std::size_t>(r);
        jacobian(r, static_cast<Index>(k)) = approximately(S((there[at] - now[at]) / delta));
      }
    }
    if (!jacobian.allFinite() || !off.allFinite()) return -1;
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> factors(jacobian);
    factors.setThreshold(difference());  // what differences in double leave of a dependent column
    // A Jacobian in double makes the iteration linear, and gains its digits in each step.
    const Eigen::VectorXd change = factors.solve(off);
    for (std::size_t k = 0; k < places.size(); ++k) values[places[k]] -= S(change[static_cast<Index>(k)]) * size;
    return factors.rank();
  }

  /// What double can tell, or rounding of the other entries leaves.
  double enough() const {
    constexpr int lost_digits = 4;
    const double of_decimals = rounding_.digits > 0 ? std::pow(double(10), lost_digits - rounding_.digits) : 0;
    return std::max(epsilon<double>() * (1 << 19), of_decimals);
  }

  /// Whether the conditions of low orders can be met.
  bool may_meet(const Places& places) const {
    return first_targets_.empty() || !solution(first_targets_, places, std::nullopt).empty();
  }

  /// Where the conditions hold to what can be told; empty if nowhere near.
  std::vector<double> solution(const std::vector<int>& targets, const Places& places,
                               const std::optional<double>& start) const {
    std::vector<double> values = written_;
    if (start)
      for (const std::size_t e : unknown_.empty() ? places : unknown_) values[e] = *start;
    constexpr int most = 40, patient = 12;
    constexpr double beyond = 100'000'000;
    double last = HUGE_VAL;
    for (int n = 0; n < most; ++n) {
      const std::vector<double> now = residuals_to(targets, values);
      const double size = norm(now);
      if (size <= enough()) return values;
      if (!std::isfinite(size) || size > beyond || (n > patient && 10 * size > 9 * last)) return {};
      last = size;
      if (newton(targets, values, now, places, difference()) < 0) return {};
    }
    return {};
  }

  /// In the digits of the scope. \return whether the conditions determine these entries and hold
  bool polish(std::vector<Mpfr>& values, const Places& places) const {
    constexpr int most = 60;
    const Mpfr delta = pow(Mpfr(10), -static_cast<int>(rounding_.working_digits) / 3);
    Mpfr last = -1;
    for (int n = 0; n < most; ++n) {
      const std::vector<Mpfr> now = residuals(values);
      const Mpfr size = norm(now);
      if (last >= 0 && size * 2 > last) break;
      last = size;
      if (newton(targets_, values, now, places, delta) < static_cast<Index>(places.size())) return false;
    }
    const std::vector<MetPart> parts = met_parts(scheme_, values, rounding_);
    for (std::size_t part = 0; part < targets_.size(); ++part)
      if (parts[part].order < targets_[part]) return false;
    return true;
  }

  void add(Repair& repair, const Places& places) const {
    // As many conditions as entries can be met by chance.
    if (conditions_ < static_cast<long>(places.size()) + 1) return;
    end_if_asked("the search for wrong entries was interrupted");
    // From what is written; a single entry, or what is unknown, also from elsewhere.
    std::vector<std::optional<double>> starts;
    if (unknown_.empty()) starts.push_back(std::nullopt);
    if (places.size() == 1 || !unknown_.empty())
      for (const int quarters : {1, 0, -2, 4, -4}) starts.emplace_back(quarters / double(4));
    for (const std::optional<double>& start : starts) {
      const std::vector<double> near = solution(targets_, places, start);
      if (near.empty()) continue;
      std::vector<Mpfr> values = exact_;
      for (const std::size_t e : places) values[e] = Mpfr(near[e]);
      if (!polish(values, places)) continue;
      const int digits = rounding_.digits > 0 ? rounding_.digits : static_cast<int>(rounding_.working_digits) - 40;
      std::vector<MendedEntry> way;
      bool changed = true;
      for (const std::size_t e : places) {
        const bool is_unknown = !scheme_.entries()[e].written.has_value();
        changed = changed && (is_unknown || magnitude(Mpfr(values[e] - exact_[e])) > pow(Mpfr(10), 2 - digits));
        way.push_back({e, to_scientific(values[e], digits), exact_form(values[e], digits - 2)});
      }
      if (changed) repair.ways.push_back(std::move(way));
      return;
    }
  }

  const Scheme& scheme_;
  const Rounding& rounding_;
  const std::vector<int>& targets_;
  std::vector<int> first_targets_;  ///< for pairs; empty if there is nothing to be seen there
  std::vector<double> written_;
  std::vector<Mpfr> exact_;
  Places unknown_, candidates_;
  long conditions_ = 0;
};

}  // namespace

Repair repair_of(const Scheme& scheme, const Rounding& rounding, const std::vector<int>& targets, int most_entries) {
  return RepairSearch(scheme, rounding, targets).find(most_entries);
}

}  // namespace hbvm::core
