#include <pybind11/stl.h>

#include <csignal>

#include "bindings.hpp"
#include "hbvm/error.hpp"
#include "hbvm/solver.hpp"
#include "supervision.hpp"

namespace hbvm::python {
namespace {

namespace py = pybind11;

/// Calls f(scene, step, until) of Python, for its CSV. What it raises becomes an error of the library's.
std::string solved(const py::function& solve, const SolverTask& task) {
  const py::gil_scoped_acquire locked;
  try {
    return py::cast<std::string>(solve(py::cast(task.scene), task.step, task.until));
  } catch (py::error_already_set& error) {
    if (error.matches(PyExc_KeyboardInterrupt)) throw Interrupted(SIGINT, "the solver was interrupted");
    throw Error(error.what());
  }
}

}  // namespace

void add_solver(py::module_& module) {
  module.def(
      "audit_solver",
      [](const std::string& name, const py::function& solve,
         const std::vector<std::pair<std::string, std::string>>& map, std::optional<int> order,
         const std::vector<Scene>& scenes, const std::optional<std::string>& until, py::object progress) {
        Supervision supervision(std::move(progress));
        SolverRequest request{.name = name, .map = map, .order = order, .scenes = scenes};
        request.solve = [&](const SolverTask& task) { return solved(solve, task); };
        if (until) request.until = Number(*until);
        request.progress = supervision.parts();
        request.stop = supervision.token();
        const SolverAudit found = supervision.of([&] { return audit_solver(request); });
        return std::pair(to_json(found), to_text(found));
      },
      py::kw_only(), py::arg("name"), py::arg("solve"), py::arg("map"), py::arg("order"), py::arg("scenes"),
      py::arg("until"), py::arg("progress"));
}

}  // namespace hbvm::python
