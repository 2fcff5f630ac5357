#pragma once

#include <string>

#include "problem/effect/program.hpp"

namespace hbvm::core {

/// A point whose motion X(t) is given, as a pivot that a motor moves. Or t, as the point (t, 0, 0): the time that one
/// effect or constraint depends on, whose work is kept apart so.
template <Scalar S>
struct DrivenPoint {
  std::string name;   ///< of the point, or of the effect or constraint
  Program<S> course;  ///< from t: X, X' and X'', d outputs each
};

/// The point (t, 0, 0).
template <Scalar S>
DrivenPoint<S> clock_point(std::string name, Index dimension);

/// The point with all numbers rounded to double.
template <Scalar S>
DrivenPoint<double> in_double(const DrivenPoint<S>& point);

}  // namespace hbvm::core
