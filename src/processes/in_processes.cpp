#include "processes/in_processes.hpp"

#include <poll.h>

#include <algorithm>
#include <cerrno>
#include <list>

#include "hbvm/error.hpp"
#include "interruption.hpp"
#include "processes/child_process.hpp"

namespace hbvm::core {
namespace {

/// A cell at work.
struct Running {
  std::size_t index;
  ChildProcess process;

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

CellRunner in_processes(const std::vector<WorkCell>& cells, int jobs, std::function<double(std::size_t)> seconds,
                        std::function<std::string(std::size_t, const ProcessEnd&)> result) {
  return [&cells, jobs, seconds = std::move(seconds), result = std::move(result)](const std::vector<std::size_t>& open,
                                                                                  const TakeResult& take) {
    std::list<Running> running;
    // A signal ends the cells at work, too, and what these say is no result.
    const auto look_at_signal = [] { end_if_asked("the work was not finished"); };
    for (auto next = open.begin(); next != open.end() || !running.empty();) {
      look_at_signal();
      while (next != open.end() && running.size() < static_cast<std::size_t>(std::max(1, jobs))) {
        running.emplace_back(*next, cells[*next].run, seconds(*next));
        ++next;
      }
      for (const auto& place : wait_for(running)) {
        look_at_signal();
        const ChildProcess& process = place->process;
        take(place->index, result(place->index, {process.text(), process.failure(), process.cpu_seconds()}));
        running.erase(place);
      }
    }
  };
}

}  // namespace hbvm::core
