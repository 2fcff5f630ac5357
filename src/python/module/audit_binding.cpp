#include <pybind11/stl.h>

#include "bindings.hpp"
#include "hbvm/audit.hpp"
#include "hbvm/scheme.hpp"
#include "supervision.hpp"

namespace py = pybind11;

namespace hbvm::python {
namespace {

using Texts = std::vector<std::string>;

Numbers numbers(const Texts& texts) { return {texts.begin(), texts.end()}; }

Claims claims_of_tableau(const std::string& name, const std::vector<Texts>& A, const Texts& b, const Texts& c,
                         std::optional<int> order, std::optional<int> digits) {
  Tableau tableau{.name = name, .A = {}, .b = numbers(b), .c = numbers(c), .order = order, .digits = digits};
  for (const Texts& row : A) tableau.A.push_back(numbers(row));
  return tableau_claims(tableau);
}

}  // namespace

void add_audit(py::module_& module) {
  py::class_<Claims>(module, "Claims")
      .def("__len__", &Claims::size)
      .def("__add__", [](const Claims& a, const Claims& b) { return a + b; });
  module.def("paper_claims", &paper_claims);
  module.def("method_claims", &method_claims);
  module.def("read_claims", &read_claims);
  module.def("read_tableau_claims", [](const std::string& path) { return tableau_claims(read_tableau(path)); });
  module.def("tableau_claims", &claims_of_tableau);
  module.def(
      "audit",
      [](const Claims& claims, int jobs, double limit, const std::optional<std::string>& until, int coefficient_digits,
         py::object progress) {
        Supervision supervision(std::move(progress));
        AuditOptions options;
        options.jobs = jobs;
        options.limit = limit;
        if (until) options.until = *until;
        options.coefficient_digits = coefficient_digits;
        options.progress = supervision.steps();
        options.stop = supervision.token();
        return supervision.of([&] { return to_json(audit(claims, options)); });
      },
      py::kw_only(), py::arg("claims"), py::arg("jobs"), py::arg("limit"), py::arg("until"),
      py::arg("coefficient_digits"), py::arg("progress"));
  module.def(
      "audit_scheme",
      [](const std::string& file, std::optional<int> order, std::optional<int> embedded_order) {
        Supervision supervision(py::none{});
        return supervision.of([&] {
          const SchemeAudit found = audit_scheme(
              {.file = file, .order = order, .embedded_order = embedded_order, .stop = supervision.token()});
          return std::tuple(to_json(found), to_text(found), found.mended);
        });
      },
      py::arg("file"), py::arg("order"), py::arg("embedded_order"));
}

}  // namespace hbvm::python
