#include <pybind11/stl.h>

#include "bindings.hpp"
#include "hbvm/cost.hpp"
#include "supervision.hpp"

namespace py = pybind11;

namespace hbvm::python {

void add_cost(py::module_& module) {
  module.def(
      "plan",
      [](const Scene& scene, const std::string& until, int digits, const std::string& quantity,
         const std::vector<std::string>& methods, const std::vector<std::string>& precisions, py::object progress) {
        Supervision supervision(std::move(progress));
        PlanRequest request{.scene = scene, .until = until, .digits = digits, .quantity = quantity};
        request.methods = methods;
        request.precisions = precisions;
        request.progress = supervision.parts();
        request.stop = supervision.token();
        const Plan found = supervision.of([&] { return plan(request); });
        return std::pair(to_json(found), found.text);
      },
      py::kw_only(), py::arg("scene"), py::arg("until"), py::arg("digits"), py::arg("quantity"), py::arg("methods"),
      py::arg("precisions"), py::arg("progress"));
}

}  // namespace hbvm::python
