#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include "bindings.hpp"
#include "figure_dict.hpp"
#include "hbvm/run.hpp"
#include "supervision.hpp"

namespace py = pybind11;

namespace hbvm::python {
namespace {

void add_trajectory(py::module_& module) {
  py::class_<Trajectory>(module, "Trajectory")
      .def(py::init([](std::vector<std::string> columns, std::vector<std::vector<std::string>> rows) {
        return Trajectory{std::move(columns), std::move(rows)};
      }))
      .def_readonly("columns", &Trajectory::columns)
      .def("__len__", [](const Trajectory& trajectory) { return trajectory.rows.size(); })
      .def("text", &Trajectory::text)
      .def("values",
           [](const Trajectory& trajectory, const std::string& column) {
             const std::vector<double> values = trajectory.values(column);
             return py::array_t<double>(static_cast<py::ssize_t>(values.size()), values.data());
           })
      .def(py::pickle([](const Trajectory& trajectory) { return py::make_tuple(trajectory.columns, trajectory.rows); },
                      [](const py::tuple& state) {
                        return Trajectory{state[0].cast<std::vector<std::string>>(),
                                          state[1].cast<std::vector<std::vector<std::string>>>()};
                      }));
}

/// \param kept a list, which gets the trajectory of a run that ends on its way
py::dict made_run(RunRequest request, py::list kept, py::object progress) {
  Supervision supervision(std::move(progress));
  request.progress = supervision.steps();
  request.stop = supervision.token();
  request.cut_short = [&](Trajectory so_far) {
    const py::gil_scoped_acquire locked;
    kept.append(std::move(so_far));
  };
  Run run = supervision.of([&] { return hbvm::run(request); });
  using namespace py::literals;
  py::dict made("json"_a = to_json(run), "text"_a = to_text(run), "state"_a = to_text(run, true));
  if (run.figure) made["figure"] = dict_of(*run.figure);
  made["page"] = run.page;
  made["trajectory"] = std::move(run.trajectory);
  return made;
}

}  // namespace

void add_run(py::module_& module) {
  add_trajectory(module);
  module.def("usual_step", [](const Scene& scene, const std::string& until) { return usual_step(scene, until); });
  module.def(
      "run",
      [](const Scene& scene, const std::string& method, const std::optional<std::string>& step,
         const std::string& until, const std::string& precision, const std::string& solver,
         const std::string& on_failure, bool reverse, bool account, bool shadow, bool horizon, bool error, bool prove,
         const std::string& start, bool picture, const std::vector<std::pair<std::string, std::string>>& portraits,
         bool linear_energy, long every, const std::vector<std::string>& at,
         const std::optional<std::string>& every_time, const std::optional<std::string>& until_event, py::list kept,
         py::object progress) {
        RunRequest request{.scene = scene, .method = method, .step = {}, .until = until};
        if (step) request.step = *step;
        request.precision = precision;
        request.solver = solver;
        request.on_failure = on_failure;
        request.reverse = reverse;
        request.account = account;
        request.shadow = shadow;
        request.horizon = horizon;
        request.prove = prove;
        request.error = error;
        request.start = start;
        request.picture = picture;
        request.portraits = portraits;
        request.linear_energy = linear_energy;
        request.every = every;
        request.at = Numbers(at.begin(), at.end());
        if (every_time) request.every_time = *every_time;
        request.until_event = until_event;
        return made_run(std::move(request), std::move(kept), std::move(progress));
      },
      py::kw_only(), py::arg("scene"), py::arg("method"), py::arg("step"), py::arg("until"), py::arg("precision"),
      py::arg("solver"), py::arg("on_failure"), py::arg("reverse"), py::arg("account"), py::arg("shadow"),
      py::arg("horizon"), py::arg("error"), py::arg("prove"), py::arg("start"), py::arg("picture"),
      py::arg("portraits"), py::arg("linear_energy"), py::arg("every"), py::arg("at"), py::arg("every_time"),
      py::arg("until_event"), py::arg("kept"), py::arg("progress"));
}

}  // namespace hbvm::python
