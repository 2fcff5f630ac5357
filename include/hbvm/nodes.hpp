#pragma once

#include <string>
#include <vector>

namespace hbvm {

/// Gauss-Legendre abscissae c and weights b on [0,1], as decimal text that reads back exactly.
struct Nodes {
  std::string precision;
  std::vector<std::string> c, b;
};

/// \throws InputError unless 1 <= n, and n is not more than the program's help says
Nodes nodes(int n, const std::string& precision = "double");

/// {"n", "precision", "c", "b"}
std::string to_json(const Nodes& nodes);

}  // namespace hbvm
