#pragma once

#include <string>
#include <vector>

#include "problem/problem.hpp"

namespace hbvm::core {

/// The driven points of a problem but t itself, by their numbers among all. Each keeps the work of an effect, a
/// constraint or a moving point.
template <Scalar S>
std::vector<std::size_t> working(const Problem<S>& problem) {
  std::vector<std::size_t> numbers;
  for (std::size_t n = 1; n < problem.driven.size(); ++n) numbers.push_back(n);
  return numbers;
}

/// Minus the sum of the components of x over driven points: of a momentum the work done, of p' the power.
template <Scalar S>
S work_done(const Problem<S>& problem, const std::vector<std::size_t>& points, const Vector<S>& x) {
  S sum = 0;
  for (const std::size_t n : points)
    for (Index j = 0; j < problem.dimension; ++j)
      sum -= x[problem.clock() + static_cast<Index>(n) * problem.dimension + j];
  return sum;
}

/// Which of the working points a name means: all that "torque" is the kind of, "effect 2", or a moving point. Without
/// a name, all.
/// \throws InputError, with what there is, for a name that means none
template <Scalar S>
std::vector<std::size_t> working(const Problem<S>& problem, const std::string& name);

}  // namespace hbvm::core
