#include "hard_cases/stability.hpp"

#include <optional>

#include "hard_cases/report.hpp"
#include "processes/in_processes.hpp"

namespace hbvm::core {

std::vector<CaseFinding> stability(const std::vector<HardCase>& cases, const StabilityOptions& options) {
  const std::string collection = options.collection == Collection::full ? "full|" : "quick|";
  std::vector<WorkCell> cells;
  for (const HardCase& c : cases)
    cells.push_back({collection + c.key(), [&c] { return to_result(judge(c, c.run())); }});

  std::vector<std::optional<double>> cpu_seconds(cases.size());
  const auto seconds = [&](std::size_t i) { return cases[i].seconds; };
  const auto result_of = [&](std::size_t i, const ProcessEnd& end) {
    cpu_seconds[i] = end.cpu_seconds;
    return end.failure.empty() ? end.text : to_result(lost(cases[i], end.failure));
  };
  const auto results = run_cells(cells, options, in_processes(cells, options.jobs, seconds, result_of));

  std::vector<CaseFinding> findings;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    if (!options.shard.has(i)) continue;
    findings.push_back(read_case_result(*results[i]));
    findings.back().cpu_seconds = cpu_seconds[i];
  }
  return findings;
}

}  // namespace hbvm::core
