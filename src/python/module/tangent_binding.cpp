#include <pybind11/stl.h>

#include "bindings.hpp"
#include "figure_dict.hpp"
#include "hbvm/reference.hpp"
#include "hbvm/tangent.hpp"
#include "supervision.hpp"

namespace py = pybind11;

namespace hbvm::python {

using namespace pybind11::literals;

void add_tangent(py::module_& module) {
  module.def(
      "tangent",
      [](const Scene& scene, const std::string& method, const std::optional<std::string>& step,
         const std::string& until, const std::string& precision, const std::vector<std::string>& constants,
         py::object progress) {
        Supervision supervision(std::move(progress));
        TangentRequest request{.scene = scene, .method = method, .step = {}, .until = until};
        if (step) request.step = *step;
        request.precision = precision;
        request.constants = constants;
        request.progress = supervision.parts();
        request.stop = supervision.token();
        const Tangent found = supervision.of([&] { return tangent(request); });
        return py::dict("json"_a = to_json(found), "text"_a = to_text(found), "figure"_a = dict_of(figure_of(found)));
      },
      py::kw_only(), py::arg("scene"), py::arg("method"), py::arg("step"), py::arg("until"), py::arg("precision"),
      py::arg("constants"), py::arg("progress"));
  module.def(
      "reference_events",
      [](const Scene& scene, const std::string& until, int digits, py::object progress) {
        Supervision supervision(std::move(progress));
        ReferenceRequest request{.scene = scene, .times = {until}, .digits = digits};
        request.progress = supervision.parts();
        request.stop = supervision.token();
        std::vector<std::tuple<std::string, bool, std::string>> events;
        for (const ReferenceEvent& event : supervision.of([&] { return reference_events(request); }))
          events.emplace_back(event.name, event.rises, event.t.text());
        return events;
      },
      py::kw_only(), py::arg("scene"), py::arg("until"), py::arg("digits"), py::arg("progress"));
}

}  // namespace hbvm::python
