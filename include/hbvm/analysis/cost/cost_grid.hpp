#pragma once

#include <string>
#include <vector>

#include "hbvm/analysis/cost/cost_cell.hpp"
#include "hbvm/reference/route_run.hpp"

namespace hbvm {

/// What a work-precision study is about.
struct CostStudy {
  Scene scene;
  Expression until;
  CostQuantity quantity = CostQuantity::all;
  double least_digits = 2, most_digits = 100;
  std::vector<MethodPtr> methods = {};
  std::vector<Precision> precisions = {};  ///< empty: those of default_precisions
  double most_seconds = 2;                 ///< of a run that is predicted to take more there is no cell
};

/// The digits that a precision can leave right in this motion.
double reachable_digits(const Precision& precision, const MotionNature& nature);

/// double, quad, and as many digits as it takes: for 15, 30, 50, 100, 200 ... right ones, up to the most.
std::vector<Precision> default_precisions(double most_digits, const MotionNature& nature);

/// The cells of a study, in a random order that is always the same: to each method and precision steps that halve, or
/// shrink by the root of 2 where the order is high, so that the errors, as ErrorModel has them, span what the precision
/// is for; but none that is predicted to take too long.
std::vector<CostCell> cost_grid(const CostStudy& study, const MotionNature& nature);

}  // namespace hbvm
