#pragma once

#include <string>
#include <vector>

#include "cost/cost_cell.hpp"
#include "reference/route_run.hpp"

namespace hbvm::core {

/// What a work-precision study is about.
struct CostStudy {
  Scene scene;
  Expression until;
  CostQuantity quantity = CostQuantity::all;
  double least_digits = 2, most_digits = 100;
  std::vector<MethodPtr> methods = {};
  std::vector<Precision> precisions = {};  ///< empty: those of default_precisions
  double most_seconds = 2;                 ///< of a run that is predicted to take more there is no cell
  bool with_steps_and_energy = false;      ///< cells for step_time_figure, energy_figure, conserving_figure, too
};

/// As many steps as there are quarters of the radius of convergence in the time of the study.
double usual_steps(const CostStudy& study, const MotionNature& nature);

/// What a usual step takes, at what its operations typically cost: no clock has a say. NaN where none can be made.
double counted_seconds(const CostStudy& study, const MethodPtr& method, const Precision& precision,
                       const MotionNature& nature);

/// The time of a study so many times, as a text; and how many times it is such a time.
std::string times_text(const Expression& until, int times);
long times_of(const Expression& time, const CostStudy& study);

/// A family as a curve names it.
std::string family_of(const Method& method);

/// What made a figure: the command and the machine.
std::string cost_footnote(const CostStudy& study);

/// The digits that a precision can leave right in this motion.
double reachable_digits(const Precision& precision, const MotionNature& nature);

/// double, quad, and as many digits as it takes: for 15, 30, 50, 100, 200 ... right ones, up to the most.
std::vector<Precision> default_precisions(double most_digits, const MotionNature& nature);

/// The cells of a study, in a random order that is always the same. The steps of each method and precision halve, or
/// shrink by the root of 2 where the order is high. Their errors, as ErrorModel has them, span what the precision is
/// for. No cell is predicted to take too long.
std::vector<CostCell> cost_grid(const CostStudy& study, const MotionNature& nature);

}  // namespace hbvm::core
