#include "hbvm/analysis/stability/stability.hpp"

#include <poll.h>

#include <algorithm>
#include <cerrno>
#include <list>
#include <optional>

#include "apart.hpp"
#include "hbvm/analysis/stability/report.hpp"
#include "hbvm/error.hpp"

namespace hbvm {
namespace {

/// A case at work.
struct Running {
  std::size_t index;
  Apart process;

  Running(std::size_t i, const std::function<std::string()>& work, double seconds) : index(i), process(work, seconds) {}
};

/// Waits until a process has something to say, and takes it from all that do. \return those that ended
std::vector<std::list<Running>::iterator> wait_for(std::list<Running>& running) {
  std::vector<pollfd> files;
  for (const Running& r : running) files.push_back({r.process.file(), POLLIN, 0});
  if (poll(files.data(), files.size(), -1) < 0 && errno != EINTR) throw Error("cannot wait for a process");
  std::vector<std::list<Running>::iterator> ended;
  auto place = running.begin();
  for (const pollfd& file : files) {
    if (file.revents != 0 && place->process.take()) ended.push_back(place);
    ++place;
  }
  return ended;
}

}  // namespace

std::vector<CaseFinding> stability(const std::vector<HardCase>& cases, const StabilityOptions& options) {
  const std::string collection = options.collection == Collection::full ? "full|" : "quick|";
  std::vector<WorkCell> cells;
  for (const HardCase& c : cases)
    cells.push_back({collection + c.key(), [&c] { return to_result(judge(c, c.run())); }});

  std::vector<std::optional<double>> cpu_seconds(cases.size());
  const auto in_processes = [&](const std::vector<std::size_t>& open, const TakeResult& take) {
    std::list<Running> running;
    for (auto next = open.begin(); next != open.end() || !running.empty();) {
      while (next != open.end() && running.size() < static_cast<std::size_t>(std::max(1, options.jobs))) {
        running.emplace_back(*next, cells[*next].run, cases[*next].seconds);
        ++next;
      }
      for (const auto& place : wait_for(running)) {
        const std::size_t i = place->index;
        const Apart& process = place->process;
        cpu_seconds[i] = process.cpu_seconds();
        take(i, process.failure().empty() ? process.text() : to_result(lost(cases[i], process.failure())));
        running.erase(place);
      }
    }
  };
  const auto results = run_cells(cells, options, in_processes);

  std::vector<CaseFinding> findings;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    if (!options.shard.has(i)) continue;
    findings.push_back(read_case_result(*results[i]));
    findings.back().cpu_seconds = cpu_seconds[i];
  }
  return findings;
}

}  // namespace hbvm
