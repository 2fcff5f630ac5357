#include <pybind11/stl.h>

#include "bindings.hpp"
#include "hbvm/method.hpp"
#include "hbvm/nodes.hpp"
#include "hbvm/number.hpp"
#include "hbvm/order.hpp"
#include "hbvm/precision.hpp"
#include "hbvm/table.hpp"

namespace py = pybind11;

namespace hbvm::python {
namespace {

std::string table_text(const std::string& heading, const std::vector<std::string>& columns,
                       const std::vector<std::vector<std::string>>& rows, const std::string& form) {
  const Table table{.caption = heading,
                    .provenance = {},
                    .key_columns = {},
                    .columns = columns,
                    .groups = {{.heading = heading, .keys = {}, .rows = rows}}};
  if (form == "csv") return to_csv(table);
  if (form == "markdown") return to_markdown(table);
  if (form == "latex") return to_latex(table);
  return to_text(table);
}

using Rate = std::pair<double, double>;  // and its uncertainty

/// \param rungs log2 of step, error and floor of each
std::optional<Rate> rate_of(const std::vector<std::array<double, 3>>& rungs) {
  std::vector<StepError> ladder;
  for (const auto& [step, error, floor] : rungs) ladder.push_back({step, error, floor});
  const std::optional<MeasuredRate> rate = measured_rate(ladder);
  if (!rate) return std::nullopt;
  return Rate(rate->value, rate->uncertainty);
}

}  // namespace

void add_facts(py::module_& module) {
  module.attr("usual_method") = usual_method;
  module.def("methods", [] { return std::pair(to_json(methods()), to_text(methods())); });
  module.def("nodes", [](int n, const std::string& precision) {
    const Nodes found = nodes(n, precision);
    return std::tuple(found.precision, found.c, found.b);
  });
  module.def("decimal",
             [](const std::string& number, const std::string& precision) { return decimal(number, precision); });
  module.def("precision_name", &precision_name);
  module.def("decimal_digits", &decimal_digits);
  module.def("table_text", &table_text);
  module.def("measured_rate", &rate_of);
  module.def("order_verdict", [](const std::optional<Rate>& rate, double order) {
    return order_verdict(rate ? std::optional(MeasuredRate{rate->first, rate->second}) : std::nullopt, order);
  });
}

}  // namespace hbvm::python
