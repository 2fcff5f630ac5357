#include "cost/cost_study.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "hbvm/error.hpp"
#include "long_work/cells.hpp"
#include "long_work/json.hpp"

namespace hbvm::core {

CostOutcome run_cost_study(const CostStudy& study, const CostOptions& options) {
  CostOutcome outcome;
  outcome.nature = find_nature(study.scene, study.until, options.store, options.reference_progress);
  // Runs that are better than they have to be are told from one another, too.
  constexpr int further_digits = 8;
  const CostReferenceRequest request{.scene = &study.scene,
                                     .until = study.until,
                                     .digits = static_cast<int>(std::ceil(study.most_digits)) + further_digits,
                                     .store = options.store,
                                     .progress = options.reference_progress};
  outcome.reference = find_cost_reference(request);
  const CostJudge judge(study.scene, outcome.reference.state, outcome.reference.digits);
  if (study.quantity == CostQuantity::lambda && !judge.has_multipliers())
    throw InputError("--quantity lambda: '" + study.scene.name + "' has no constraints, and so no multipliers");

  const std::vector<CostCell> grid = cost_grid(study, outcome.nature);
  if (grid.empty())
    throw InputError("no method of the list reaches such digits in " + std::to_string(study.most_seconds) +
                     " s: take more of them, with --seconds, or another --digits-range");
  outcome.cells = grid.size();
  const std::string of = "cost|" + scene_hash(study.scene) + "|" + study.until.text() + "|" +
                         std::to_string(outcome.reference.digits) + "|";
  std::vector<WorkCell> cells;
  for (const CostCell& cell : grid)
    cells.push_back({of + cell.key(), [&] { return to_result(measure_cost(study.scene, study.until, cell, judge)); }});
  std::vector<CostCell> steps, energies, conserving;
  if (study.with_steps_and_energy) {
    steps = step_time_cells(study, outcome.nature);
    energies = energy_cells(study, outcome.nature);
    conserving = conserving_cells(study, outcome.nature);
    outcome.energy_until = energy_until(study, outcome.nature);
  }
  const std::string scene = scene_hash(study.scene) + "|";
  for (const CostCell& cell : steps)
    cells.push_back(
        {"step|" + scene + study.until.text() + "|" + cell.key(), [&] { return measure_step_time(study, cell); }});
  const auto add_energies = [&](const std::vector<CostCell>& those, const Expression& until) {
    for (const CostCell& cell : those)
      cells.push_back({"energy|" + scene + until.text() + "|" + cell.key(),
                       [&] { return measure_energy(study.scene, until, cell); }});
  };
  if (outcome.energy_until) add_energies(energies, *outcome.energy_until);
  add_energies(conserving, study.until);
  // Predictions may be off by so much, and a run is repeated.
  constexpr double patience = 60;
  const auto seconds = [&](std::size_t) { return 2 + patience * study.most_seconds; };
  const auto result = [&](std::size_t i, const ProcessEnd& end) {
    if (end.failure.empty()) return end.text;
    if (i >= grid.size()) return dumped({{"failure", end.failure}}, -1);
    CostMeasurement lost;
    lost.method = grid[i].method->text();
    lost.failure = end.failure;
    return to_result(lost);
  };
  const auto results = options.apart ? run_cells(cells, options, options.apart(cells, options.jobs, seconds, result))
                                     : run_cells(cells, options);

  for (std::size_t i = 0; i < grid.size(); ++i)
    if (results[i]) outcome.findings.push_back({grid[i], read_cost_measurement(*results[i])});
  outcome.complete = std::all_of(results.begin(), results.end(), [](const auto& r) { return r.has_value(); });
  std::size_t place_of_result = grid.size();
  const auto take = [&](const std::vector<CostCell>& those, auto& found, const auto& read) {
    for (const CostCell& cell : those)
      if (const auto& text = results[place_of_result++]) found.push_back(read(cell, *text));
  };
  take(steps, outcome.step_times, read_step_time);
  take(energies, outcome.energies, read_energy_cost);
  take(conserving, outcome.conserving, read_energy_cost);
  // As the grid has them before they were shuffled.
  const auto place = [&](const CostFinding& f) {
    const auto method = std::find_if(study.methods.begin(), study.methods.end(),
                                     [&](const MethodPtr& m) { return m->key() == f.cell.method->key(); });
    const Precision& p = f.cell.precision;
    return std::tuple(static_cast<int>(p.kind()), p.digits(), method - study.methods.begin(), f.cell.steps);
  };
  std::sort(outcome.findings.begin(), outcome.findings.end(),
            [&](const CostFinding& a, const CostFinding& b) { return place(a) < place(b); });
  return outcome;
}

}  // namespace hbvm::core
