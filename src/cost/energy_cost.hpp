#pragma once

#include <string>
#include <vector>

#include "cost/cost_cell.hpp"
#include "cost/cost_grid.hpp"
#include "hbvm/figure.hpp"
#include "hbvm/table.hpp"

namespace hbvm::core {

/// A run of which the energy is looked at.
struct EnergyCost {
  CostCell cell;
  std::string method = {};  ///< with its k as chosen
  std::string failure = {};
  double seconds = 0;                  ///< of the processor, all steps: the least of some runs
  double log10_round_off = 0;          ///< what rounding explains at the end
  std::vector<PlotPoint> growth = {};  ///< log10 of t, log10 of the greatest error of H so far, relative to its terms
  double log10_error() const { return growth.empty() ? 0 : growth.back()[1]; }
};

/// Until when energies are looked at: ten, a hundred or a thousand times the time of the study, as its most seconds
/// allow.
Expression energy_until(const CostStudy& study, const MotionNature& nature);

/// Runs in double to energy_until(), of the member of each family of the study whose order is next to 4. Their steps
/// are predicted to take from half to twice the time of HBVM(2,2) with a quarter of the radius of convergence.
std::vector<CostCell> energy_cells(const CostStudy& study, const MotionNature& nature);

/// Runs of HBVM(k,s), s = 1 to 4, with k from s to 6s, to the time of the study, in double and 40 digits.
std::vector<CostCell> conserving_cells(const CostStudy& study, const MotionNature& nature);

/// As JSON, and back. \throws InputError if it is none
std::string measure_energy(const Scene& scene, const Expression& until, const CostCell& cell);
EnergyCost read_energy_cost(const CostCell& cell, const std::string& text);

/// Of each method the run that took next to the time of HBVM(2,2), or the middle one if that is not among them.
std::vector<const EnergyCost*> at_equal_cost(const std::vector<EnergyCost>& runs);

/// A row a run.
Table energy_table(const CostStudy& study, const Expression& until, const std::vector<EnergyCost>& runs);

/// The error of H against time, a curve a method, at equal cost; and against the processor time, all runs.
Figure energy_figure(const CostStudy& study, const Expression& until, const std::vector<EnergyCost>& runs);
/// What more nodes than stages cost, and what the error of H is with them.
Figure conserving_figure(const CostStudy& study, const std::vector<EnergyCost>& runs);

}  // namespace hbvm::core
