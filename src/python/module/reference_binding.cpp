#include <pybind11/stl.h>

#include "bindings.hpp"
#include "hbvm/reference.hpp"
#include "hbvm/results.hpp"
#include "supervision.hpp"

namespace py = pybind11;

namespace hbvm::python {

namespace {

void add_exact_motion(py::module_& module) {
  module.def(
      "reference",
      [](const Scene& scene, const std::vector<std::string>& times, int digits, const std::string& route, bool force,
         bool prove, py::object progress) {
        Supervision supervision(std::move(progress));
        ReferenceRequest request{.scene = scene, .times = {times.begin(), times.end()}, .digits = digits};
        request.route = route;
        request.force = force;
        request.prove = request.keep_proof = prove;
        request.progress = supervision.parts();
        request.stop = supervision.token();
        const Reference found = supervision.of([&] { return reference(request); });
        return std::tuple(to_json(found), found.proof);
      },
      py::kw_only(), py::arg("scene"), py::arg("times"), py::arg("digits"), py::arg("route"), py::arg("force"),
      py::arg("prove"), py::arg("progress"));
  module.def(
      "check_proof",
      [](const std::string& text, const std::string& name, py::object progress) {
        Supervision supervision(std::move(progress));
        const ProofRequest request{
            .text = text, .name = name, .progress = supervision.parts(), .stop = supervision.token()};
        const Reference found = supervision.of([&] { return check_proof(request); });
        return std::tuple(to_json(found), found.scene_toml, found.scene);
      },
      py::kw_only(), py::arg("text"), py::arg("name"), py::arg("progress"));
}

void add_comparison(py::module_& module) {
  using File = std::tuple<std::string, std::string, std::string>;  // name, CSV, step
  module.def(
      "compare_results",
      [](const Scene& scene, const std::vector<File>& files,
         const std::vector<std::pair<std::string, std::string>>& map, bool cost, py::object progress) {
        Supervision supervision(std::move(progress));
        ResultsRequest request{.scene = scene, .files = {}, .map = map, .cost = cost};
        for (const auto& [name, csv, step] : files) request.files.push_back({name, csv, step});
        request.progress = supervision.parts();
        request.stop = supervision.token();
        const Comparison found = supervision.of([&] { return compare_results(request); });
        return std::tuple(to_json(found), to_text(found), found.least_digits());
      },
      py::kw_only(), py::arg("scene"), py::arg("files"), py::arg("map"), py::arg("cost"), py::arg("progress"));
}

}  // namespace

void add_reference(py::module_& module) {
  add_exact_motion(module);
  add_comparison(module);
}

}  // namespace hbvm::python
