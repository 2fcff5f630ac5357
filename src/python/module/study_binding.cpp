#include <pybind11/stl.h>

#include "bindings.hpp"
#include "figure_dict.hpp"
#include "hbvm/study.hpp"
#include "supervision.hpp"

namespace py = pybind11;

namespace hbvm::python {
namespace {

using namespace pybind11::literals;
using Texts = std::vector<std::string>;

py::object figure_of(const std::optional<Figure>& figure) {
  if (figure) return dict_of(*figure);
  return py::none();
}

void add_compare(py::module_& module) {
  module.def(
      "compare",
      [](const Scene& scene, const Texts& methods, const std::optional<std::string>& step, const std::string& until,
         const std::string& precision, bool reference, bool picture, py::object progress) {
        Supervision supervision(std::move(progress));
        MethodsRequest request{.scene = scene, .methods = methods, .step = {}, .until = until, .precision = precision};
        if (step) request.step = *step;
        request.reference = reference;
        request.picture = picture;
        request.progress = supervision.steps();
        request.stop = supervision.token();
        const MethodComparison found = supervision.of([&] { return compare_methods(request); });
        return py::dict("json"_a = to_json(found), "text"_a = to_text(found), "figure"_a = figure_of(found.figure),
                        "page"_a = found.page);
      },
      py::kw_only(), py::arg("scene"), py::arg("methods"), py::arg("step"), py::arg("until"), py::arg("precision"),
      py::arg("reference"), py::arg("picture"), py::arg("progress"));
}

void add_convergence(py::module_& module) {
  module.def(
      "convergence",
      [](const Scene& scene, const Texts& methods, const std::string& steps, const std::optional<std::string>& until,
         const Texts& precisions, bool propagated, py::object progress) {
        Supervision supervision(std::move(progress));
        ConvergenceRequest request{.scene = scene, .methods = methods, .steps = steps};
        if (until) request.until = *until;
        request.precisions = precisions;
        request.propagated = propagated;
        request.picture = true;
        request.progress = supervision.steps();
        request.stop = supervision.token();
        const ConvergenceStudy found = supervision.of([&] { return convergence(request); });
        return py::dict("json"_a = to_json(found), "text"_a = to_text(found), "figure"_a = figure_of(found.figure));
      },
      py::kw_only(), py::arg("scene"), py::arg("methods"), py::arg("steps"), py::arg("until"), py::arg("precisions"),
      py::arg("propagated"), py::arg("progress"));
}

}  // namespace

void add_study(py::module_& module) {
  add_compare(module);
  add_convergence(module);
  module.def(
      "study",
      [](const std::string& folder, const std::string& precision, bool check, const std::string& out, int jobs,
         py::object progress) {
        Supervision supervision(std::move(progress));
        StudyRequest request{.folder = folder, .precision = precision, .check = check, .out = out};
        request.jobs = jobs;
        request.progress = supervision.steps();
        request.stop = supervision.token();
        return supervision.of([&] { return to_json(study(request)); });
      },
      py::kw_only(), py::arg("folder"), py::arg("precision"), py::arg("check"), py::arg("out"), py::arg("jobs"),
      py::arg("progress"));
}

}  // namespace hbvm::python
