#include <fmt/format.h>

#include <iostream>
#include <memory>

#include "basis/gauss_legendre.hpp"
#include "commands.hpp"
#include "hbvm/nodes.hpp"

namespace hbvm::core {
namespace {

struct NodesArguments {
  int n = 0;
  std::string precision = "double";
  bool json = false;
};

void nodes_command(const NodesArguments& o) {
  const Nodes found = nodes(o.n, o.precision);
  if (o.json) {
    std::cout << to_json(found) << std::endl;
    return;
  }
  fmt::print("# Gauss-Legendre abscissae and weights on [0,1], n = {}, {}\n", o.n, found.precision);
  for (std::size_t i = 0; i < found.c.size(); ++i) fmt::print("{} {}\n", found.c[i], found.b[i]);
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

}  // namespace hbvm::core
