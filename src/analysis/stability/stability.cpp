#include "hbvm/analysis/stability/stability.hpp"

#include <poll.h>

#include <algorithm>
#include <cerrno>
#include <list>
#include <sstream>

#include "apart.hpp"
#include "hbvm/analysis/stability/report.hpp"
#include "hbvm/error.hpp"

namespace hbvm {
namespace {

/// A case at work.
struct Running {
  std::size_t index;
  Apart process;

  Running(std::size_t i, const HardCase& c)
      : index(i), process([&c] { return to_line(judge(c, c.run()), c.key()); }, c.seconds) {}
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
  std::vector<CaseFinding> findings(cases.size());
  std::vector<std::size_t> open;
  long decided = 0;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const CaseFinding* const known = options.known ? options.known(cases[i].key()) : nullptr;
    if (known)
      findings[i] = *known;
    else
      open.push_back(i);
    decided += known != nullptr;
  }
  const auto report = [&] {
    if (options.progress) options.progress(decided, static_cast<long>(cases.size()));
  };
  report();

  std::list<Running> running;
  for (auto next = open.begin(); next != open.end() || !running.empty();) {
    while (next != open.end() && running.size() < static_cast<std::size_t>(std::max(1, options.jobs))) {
      running.emplace_back(*next, cases[*next]);
      ++next;
    }
    for (const auto& place : wait_for(running)) {
      const HardCase& c = cases[place->index];
      CaseFinding& finding = findings[place->index];
      if (place->process.failure().empty()) {
        std::istringstream line(place->process.text());
        finding = read_case_lines(line).at(c.key());
      } else {
        finding = lost(c, place->process.failure());
      }
      finding.cpu_seconds = place->process.cpu_seconds();
      running.erase(place);
      if (options.found) options.found(c.key(), finding);
      ++decided;
      report();
    }
  }
  return findings;
}

}  // namespace hbvm
