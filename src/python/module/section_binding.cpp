#include <pybind11/stl.h>

#include "bindings.hpp"
#include "figure_dict.hpp"
#include "hbvm/periodic.hpp"
#include "hbvm/section.hpp"
#include "supervision.hpp"

namespace py = pybind11;

namespace hbvm::python {

using namespace pybind11::literals;

void add_section(py::module_& module) {
  module.def(
      "section",
      [](const Scene& scene, const std::string& plane, const std::string& direction,
         const std::pair<std::string, std::string>& axes, const std::vector<std::string>& starts,
         const std::string& method, const std::optional<std::string>& step, const std::string& until,
         const std::string& precision, int jobs, py::object progress) {
        Supervision supervision(std::move(progress));
        SectionRequest request{.scene = scene,
                               .plane = plane,
                               .direction = direction,
                               .axes = axes,
                               .starts = starts,
                               .method = method,
                               .step = {},
                               .until = until};
        if (step) request.step = *step;
        request.precision = precision;
        request.jobs = jobs;
        request.progress = supervision.steps();
        request.stop = supervision.token();
        const auto [found, page] = supervision.of([&] {
          const Section made = section(request);
          return std::pair(made, page_of(made, request));
        });
        return py::dict("json"_a = to_json(found), "text"_a = to_text(found), "csv"_a = to_csv(found),
                        "figure"_a = dict_of(figure_of(found)), "page"_a = page);
      },
      py::kw_only(), py::arg("scene"), py::arg("plane"), py::arg("direction"), py::arg("axes"), py::arg("starts"),
      py::arg("method"), py::arg("step"), py::arg("until"), py::arg("precision"), py::arg("jobs"), py::arg("progress"));
  module.def(
      "periodic",
      [](const Scene& scene, const std::string& until, const std::optional<std::string>& plane, int digits,
         py::object progress) {
        Supervision supervision(std::move(progress));
        PeriodicRequest request{.scene = scene, .until = until, .plane = plane};
        request.digits = digits;
        request.progress = supervision.parts();
        request.stop = supervision.token();
        const Periodic found = supervision.of([&] { return periodic(request); });
        return std::pair(to_json(found), to_text(found));
      },
      py::kw_only(), py::arg("scene"), py::arg("until"), py::arg("plane"), py::arg("digits"), py::arg("progress"));
}

}  // namespace hbvm::python
