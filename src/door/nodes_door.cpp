#include "basis/gauss_legendre.hpp"
#include "hbvm/nodes.hpp"
#include "linear/vector_text.hpp"
#include "long_work/json.hpp"
#include "scalar/with_scalar.hpp"

namespace hbvm {

Nodes nodes(int n, const std::string& name) {
  const core::Precision precision = core::Precision::parse(name);
  Nodes result{precision.name(), {}, {}};
  core::with_scalar(precision, [&]<core::Scalar S>() {
    const core::Quadrature<S> formula = core::gauss_legendre<S>(n);
    result.c = core::to_texts<S>(formula.c);
    result.b = core::to_texts<S>(formula.b);
    return 0;
  });
  return result;
}

std::string to_json(const Nodes& nodes) {
  return core::dumped({{"n", nodes.c.size()}, {"precision", nodes.precision}, {"c", nodes.c}, {"b", nodes.b}}, 2);
}

}  // namespace hbvm
