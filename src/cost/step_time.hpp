#pragma once

#include <string>
#include <vector>

#include "cost/cost_cell.hpp"
#include "cost/cost_grid.hpp"
#include "hbvm/figure.hpp"
#include "hbvm/table.hpp"

namespace hbvm::core {

/// What a step of one size costs in a precision.
struct StepTime {
  CostCell cell;  ///< with as many steps as the method needed to make them
  std::string failure = {};
  double seconds = 0;     ///< of the processor, a step
  double operations = 0;  ///< a step, in the working precision
};

/// Some methods of the study with a quarter of the radius of convergence for a step, in double, quad and 20 to 1000
/// digits.
std::vector<CostCell> step_time_cells(const CostStudy& study, const MotionNature& nature);

/// The least of a few times of some steps, half as long again and again where the method fails, as JSON, and back.
/// \throws InputError if it is none
std::string measure_step_time(const CostStudy& study, const CostCell& cell);
StepTime read_step_time(const CostCell& cell, const std::string& text);

/// A row a method and precision.
Table step_time_table(const CostStudy& study, const std::vector<StepTime>& times);

/// The time of a step against the digits, and that in quad over that with mpfr:34.
Figure step_time_figure(const CostStudy& study, const std::vector<StepTime>& times);

}  // namespace hbvm::core
