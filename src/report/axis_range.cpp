#include "axis_range.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace hbvm::core {
namespace {

/// The least of 1, 2, 5, 10, 20, ... that is not below x > 0.
double round_above(double x) {
  const double power = std::pow(10, std::floor(std::log10(x)));
  for (const int step : {1, 2, 5})
    if (step * power >= x * (1 - 1e-12)) return step * power;
  return 10 * power;
}

/// The multiples of a step that lie in the range, with room for what rounding does to its ends.
std::pair<long, long> multiples(const AxisRange& range, double step) {
  constexpr double slack = 1e-9;
  return {std::lround(std::ceil(range.from / step - slack)), std::lround(std::floor(range.to / step + slack))};
}

Tics linear_tics(const AxisRange& range, int most) {
  double step = round_above(range.length() / most);
  const auto count = [&] {
    const auto [first, last] = multiples(range, step);
    return last - first + 1;
  };
  while (count() > most) step = round_above(step * 1.5);
  Tics result;
  const auto [first, last] = multiples(range, step);
  const double greatest = step * static_cast<double>(std::max(std::labs(first), std::labs(last)));
  // Numbers of more than five digits before the point, or of three zeros behind it, have a power in common.
  const int exponent = greatest > 0 ? static_cast<int>(std::floor(std::log10(greatest) + 1e-9)) : 0;
  const int common = exponent >= 5 || exponent <= -3 ? exponent : 0;
  if (common != 0) result.factor = fmt::format("10^{{{}}}", common);
  const int decimals = std::max(0, common - static_cast<int>(std::floor(std::log10(step) + 1e-9)));
  for (long n = first; n <= last; ++n) {
    const double at = step * static_cast<double>(n);
    result.tics.push_back({at, fmt::format("{:.{}f}", n == 0 ? 0 : at / std::pow(10, common), decimals)});
  }
  return result;
}

/// Powers of a base at integers, or at their opposites, at most so many of them with a number.
Tics power_tics(const AxisRange& range, int base, int most, int sign = 1) {
  const auto [first, last] = multiples(range, 1);
  long step = 1;
  for (const long candidate : {1, 2, 3, 4, 5, 10, 20, 50, 100, 200, 500, 1000}) {
    step = candidate;
    if ((last - first) / step + 1 <= most) break;
  }
  Tics result;
  for (long n = first; n <= last; ++n)
    result.tics.push_back(
        {static_cast<double>(n), n % step == 0 ? fmt::format("{}^{{{}}}", base, sign * n) : std::string()});
  return result;
}

Tics decimal_tics(const AxisRange& range, int most) {
  Tics result = power_tics(range, 10, most);
  constexpr int fine = 8;
  if (range.length() > fine) return result;
  // Counts of something, as digits from 20 to 1000, are written out.
  constexpr double at_most = 4, few_powers = 2.5;
  const bool counts = range.from >= 0 && range.to <= at_most && range.length() <= few_powers;
  const auto text = [&](int digit, long power) {
    if (counts) return fmt::format("{}{}", digit, std::string(static_cast<std::size_t>(power), '0'));
    return fmt::format("{}·10^{{{}}}", digit, power);
  };
  if (counts)
    for (Tic& tic : result.tics) tic.text = text(1, std::lround(tic.at));
  const auto [first, last] = multiples({std::floor(range.from), std::ceil(range.to)}, 1);
  const auto is_inside = [&](int digit, long power) {
    const double at = static_cast<double>(power) + std::log10(digit);
    constexpr double rounding = 1e-9;
    return at >= range.from - rounding && at <= range.to + rounding;
  };
  // Few powers of ten: 2 and 5 times them bear numbers, too.
  auto written = std::count_if(result.tics.begin(), result.tics.end(), [](const Tic& t) { return !t.text.empty(); });
  const bool few = written < 2;
  for (long n = first; n <= last; ++n) written += is_inside(2, n) + is_inside(5, n);
  const bool numbered = few || (counts && written <= most);
  for (long n = first; n <= last; ++n)
    for (int digit = 2; digit <= 9; ++digit) {
      if (!is_inside(digit, n)) continue;
      const double at = static_cast<double>(n) + std::log10(digit);
      const bool with_number = numbered && (digit == 2 || digit == 5);
      result.tics.push_back({at, with_number ? text(digit, n) : std::string()});
    }
  return result;
}

}  // namespace

AxisRange range_of(const std::vector<double>& values, AxisScale scale) {
  AxisRange range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    range.from = std::min(range.from, value);
    range.to = std::max(range.to, value);
  }
  if (range.from > range.to) return {0, 1};
  // Numbers whose difference a picture cannot show.
  const double least = 1e-9 * std::max(std::abs(range.from), std::abs(range.to));
  const double middle = range.from + range.length() / 2;
  // Of powers at least one must be within, and of those of 10 one, twice or five times it.
  const double tics = scale == AxisScale::linear ? 0 : scale == AxisScale::decimal ? 0.42 : 1.05;
  if (range.length() > std::max(least, tics)) return range;
  const double half = tics > 0 ? tics / 2 : middle != 0 ? std::abs(middle) / 10 : 1;
  return {middle - half, middle + half};
}

AxisRange ended_at_round_off(const AxisRange& range, double round_off) {
  constexpr int below = 1, least = 2;
  const double from = round_off - below;
  return {from, std::max(range.to, from + least)};
}

AxisRange widened(const AxisRange& range, double share) {
  return {range.from - share * range.length(), range.to + share * range.length()};
}

Tics tics_of(const AxisRange& range, AxisScale scale, int most) {
  if (scale == AxisScale::linear) return linear_tics(range, most);
  if (scale == AxisScale::decimal) return decimal_tics(range, most);
  return scale == AxisScale::binary ? power_tics(range, 2, most) : power_tics(range, 10, most, -1);
}

}  // namespace hbvm::core
