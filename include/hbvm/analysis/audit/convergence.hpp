#pragma once

#include <optional>
#include <vector>

namespace hbvm {

/// An error at one step, as binary logarithms: no precision is too high for them.
struct Rung {
  double step;                ///< log2 h
  double error;               ///< log2 of the error; its greatest over several starts
  double floor;               ///< log2 of what round-off and the error of the reference explain
  bool by_reference = false;  ///< it is the error of the reference that counts: a better one could show more
  bool is_clean() const { return error > floor; }
};

/// A slope d log(error) / d log(h) and what it can be trusted to: the truth lies within value +- uncertainty.
struct Rate {
  double value = 0, uncertainty = 0;
  double halvings = 0;  ///< of the step, between the first and the last rung used
  double decades = 0;   ///< of the error, likewise
};

/// The slope over the five finest clean rungs by least squares. Its uncertainty is the half-width of the 95 %
/// confidence interval (Student's t with three degrees of freedom) or, if that is greater, how far the slope between
/// the two finest rungs is from it: before the asymptotic regime slopes vary smoothly. \param rungs from coarse to fine
/// \return nothing if there are fewer than five clean rungs, or less than four halvings between them
std::optional<Rate> convergence_rate(const std::vector<Rung>& rungs);

}  // namespace hbvm
