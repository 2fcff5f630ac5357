#include "audit/convergence.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace hbvm::core {
namespace {

constexpr std::size_t needed = 5;

/// By how much log2 of the error may be off: what lies under the floor is part of it, or missing.
double noise(const Rung& rung) { return std::log2(1 + std::exp2(rung.floor - rung.error)); }

/// A slope between two rungs, and how far off it may be. `shift` says how much a term h^n in the error shifts it, for
/// n = 1 and 2, but for a factor common to all.
struct Slope {
  double value, noise, shift[2];
};

Slope slope_between(const Rung& coarse, const Rung& fine, double finest) {
  const double width = coarse.step - fine.step;
  Slope slope{(coarse.error - fine.error) / width, (noise(coarse) + noise(fine)) / width, {}};
  for (const int n : {1, 2})
    slope.shift[n - 1] = (std::exp2(n * (coarse.step - finest)) - std::exp2(n * (fine.step - finest))) / width;
  return slope;
}

/// The rate that the slopes between five rungs tend to. If the error is C h^p (1 + a h^n), two slopes tell p and a. The
/// rate lies between what n = 1 and n = 2 make of the last two.
Rate rate_of(std::span<const Rung> rungs) {
  std::vector<Slope> slopes;
  for (std::size_t i = 1; i < rungs.size(); ++i)
    slopes.push_back(slope_between(rungs[i - 1], rungs[i], rungs.back().step));
  const Slope &last = slopes[needed - 2], &before = slopes[needed - 3];
  const auto left = [&](int n) { return last.shift[n - 1] / (before.shift[n - 1] - last.shift[n - 1]); };
  const double first = left(1), mean = (first + left(2)) / 2;
  Rate rate;
  rate.value = last.value + mean * (last.value - before.value);
  // Each difference foretells the last one, of which chance may have made a small one.
  double difference = 0;
  bool grows = true;
  for (std::size_t i = 1; i < slopes.size(); ++i) {
    const double own = std::abs(slopes[i].value - slopes[i - 1].value);
    difference =
        std::max(difference, own * (before.shift[0] - last.shift[0]) / (slopes[i - 1].shift[0] - slopes[i].shift[0]));
    if (i == 1) continue;
    const double earlier = std::abs(slopes[i - 1].value - slopes[i - 2].value);
    grows = grows && own - slopes[i].noise - slopes[i - 1].noise > earlier;
  }
  // Twice what the slower model leaves: the greatest of several errors is no smooth function.
  rate.uncertainty = 2 * first * difference + last.noise + mean * (last.noise + before.noise);
  // Where another term takes over: the slope goes on changing, nobody knows how far.
  if (grows) rate.uncertainty = std::numeric_limits<double>::infinity();
  rate.halvings = rungs.front().step - rungs.back().step;
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

}  // namespace hbvm::core
