#include <fmt/format.h>

#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "basis/gauss_legendre.hpp"
#include "commands.hpp"
#include "scalar/text.hpp"
#include "scalar/with_scalar.hpp"

namespace hbvm {
namespace {

struct NodesArguments {
  int n = 0;
  std::string precision = "double";
  bool json = false;
};

void nodes_command(const NodesArguments& o) {
  const Precision precision = Precision::parse(o.precision);
  std::vector<std::string> c, b;
  with_scalar(precision, [&]<Scalar S>() {
    const Quadrature<S> formula = gauss_legendre<S>(o.n);
    for (int i = 0; i < o.n; ++i) {
      c.push_back(to_text(formula.c[i]));
      b.push_back(to_text(formula.b[i]));
    }
    return 0;
  });
  if (o.json) {
    const nlohmann::ordered_json j{{"n", o.n}, {"precision", precision.name()}, {"c", c}, {"b", b}};
    std::cout << j.dump(2) << std::endl;
    return;
  }
  fmt::print("# Gauss-Legendre abscissae and weights on [0,1], n = {}, {}\n", o.n, precision.name());
  for (std::size_t i = 0; i < c.size(); ++i) fmt::print("{} {}\n", c[i], b[i]);
}

}  // namespace

void add_nodes_command(CLI::App& app) {
  auto o = std::make_shared<NodesArguments>();
  CLI::App* const command = app.add_subcommand("nodes", "Print Gauss-Legendre abscissae and weights on [0,1]");
  command->add_option("N", o->n, "Number of nodes, 1 to " + std::to_string(max_quadrature_nodes))->required();
  command->add_option("--precision", o->precision, "double, quad, or mpfr:N, or N alone, for N digits")
      ->capture_default_str();
  command->add_flag("--json", o->json, "Print one JSON object and nothing else");
  command->footer("Example: hbvm nodes 5 --precision mpfr:50");
  command->callback([o] { nodes_command(*o); });
}

}  // namespace hbvm
