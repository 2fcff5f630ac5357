#pragma once

#include <string>
#include <vector>

#include "hbvm/figure.hpp"

namespace hbvm::core {

/// The part of an axis that is shown.
struct AxisRange {
  double from = 0, to = 1;

  double length() const { return to - from; }
};

/// A place on an axis where a number stands; without a text a small line alone.
struct Tic {
  double at;
  std::string text;
};

/// The tics of an axis at round numbers, and what its label has to say besides. That is a power of ten that all of them
/// have in common, as gnuplot writes it ("10^{-9}"). Empty if none.
struct Tics {
  std::vector<Tic> tics;
  std::string factor;
};

/// The range from the least to the greatest of the finite values. One value, or none, has a range about it as wide as
/// can be shown. On axes of powers it makes room for a tic with a number.
AxisRange range_of(const std::vector<double>& values, AxisScale scale = AxisScale::linear);

/// The range on an axis of decimal powers where all below this is round-off. It ends a decade below that, and is
/// two decades long at least.
AxisRange ended_at_round_off(const AxisRange& range, double round_off);

/// The range, made wider by this share of it at both ends.
AxisRange widened(const AxisRange& range, double share);

/// The tics of an axis, with at most so many numbers.
Tics tics_of(const AxisRange& range, AxisScale scale, int most);

}  // namespace hbvm::core
