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

/// The tics of an axis at round numbers, and what its label has to say besides: a power of ten that all of them have in
/// common, as gnuplot writes it ("10^{-9}"); empty if none.
struct Tics {
  std::vector<Tic> tics;
  std::string factor;
};

/// From the least to the greatest of the finite values; of one value, or none, as far about it as can be shown, and on
/// the axes of powers as far as makes room for a tic with a number.
AxisRange range_of(const std::vector<double>& values, AxisScale scale = AxisScale::linear);

/// The same with this share of it left free at both ends.
AxisRange widened(const AxisRange& range, double share);

/// At most so many numbers at an axis.
Tics tics_of(const AxisRange& range, AxisScale scale, int most);

}  // namespace hbvm::core
