#include "hbvm/analysis/audit/convergence.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

namespace hbvm {
namespace {

constexpr std::size_t needed = 5;

/// By how much log2 of the error may be off: what lies under the floor is part of it, or missing.
double noise(const Rung& rung) { return std::log2(1 + std::exp2(rung.floor - rung.error)); }

/// A slope between two rungs, and how far off it may be.
struct Slope {
  double value, noise;
};

/// The rate that the slopes between five rungs tend to. An expansion C h^p (1 + a h^n + ...) has slopes that differ
/// from p by terms in h^n, so that the next of them, and all after it, are off by the last difference over rho^n - 1,
/// where the steps fall by rho: the rate lies between what n = 1 and n = 2 say.
Rate rate_of(std::span<const Rung> rungs) {
  std::vector<Slope> slopes;
  for (std::size_t i = 1; i < rungs.size(); ++i) {
    const double width = rungs[i - 1].step - rungs[i].step;
    slopes.push_back({(rungs[i - 1].error - rungs[i].error) / width, (noise(rungs[i - 1]) + noise(rungs[i])) / width});
  }
  const double last_width = rungs[needed - 2].step - rungs[needed - 1].step, rho = std::exp2(last_width);
  const double first = 1 / (rho - 1), second = 1 / (rho * rho - 1), mean = (first + second) / 2;
  const Slope &last = slopes[needed - 2], &before = slopes[needed - 3];
  Rate rate;
  rate.value = last.value + mean * (last.value - before.value);
  // Each difference foretells the last one: by chance that may be small.
  double difference = 0;
  bool grows = true;
  for (std::size_t i = 1; i < slopes.size(); ++i) {
    const double own = std::abs(slopes[i].value - slopes[i - 1].value);
    difference = std::max(difference, own * std::exp2(rungs[needed - 1].step - rungs[i + 1].step));
    if (i == 1) continue;
    const double earlier = std::abs(slopes[i - 1].value - slopes[i - 2].value);
    grows = grows && own - slopes[i].noise - slopes[i - 1].noise > earlier;
  }
  rate.uncertainty = first * difference + last.noise + mean * (last.noise + before.noise);
  // Where another term takes over: the slope goes on changing, nobody knows how far.
  if (grows) rate.uncertainty = std::numeric_limits<double>::infinity();
  rate.halvings = rungs.front().step - rungs.back().step;
  rate.decades = (rungs.front().error - rungs.back().error) * std::numbers::ln2 / std::numbers::ln10;
  return rate;
}

/// Whether finer rungs lie where a rate has them.
bool agree(const Rate& rate, const Rung& last, std::span<const Rung> finer) {
  return std::all_of(finer.begin(), finer.end(), [&](const Rung& rung) {
    const double distance = last.step - rung.step, expected = last.error - rate.value * distance;
    const double rounding = std::exp2(-36) * std::abs(rung.error);
    return std::abs(rung.error - expected) <= rate.uncertainty * distance + noise(last) + noise(rung) + rounding;
  });
}

}  // namespace

std::optional<Rate> convergence_rate(const std::vector<Rung>& rungs) {
  std::vector<Rung> clean;
  std::copy_if(rungs.begin(), rungs.end(), std::back_inserter(clean), [](const Rung& r) { return r.is_clean(); });
  const std::span all(clean);
  std::optional<Rate> best;
  for (std::size_t end = clean.size(); end >= needed; --end) {
    const auto window = all.subspan(end - needed, needed);
    if (window.front().step - window.back().step < needed - 1) continue;
    const Rate rate = rate_of(window);
    if (best && !agree(rate, window.back(), all.subspan(end))) break;
    if (!best || rate.uncertainty < best->uncertainty) best = rate;
  }
  return best;
}

}  // namespace hbvm
