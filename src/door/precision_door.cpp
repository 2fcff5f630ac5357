#include "hbvm/precision.hpp"
#include "scalar/precision.hpp"

namespace hbvm {

std::string precision_name(const std::string& precision) { return core::Precision::parse(precision).name(); }

int decimal_digits(const std::string& precision) {
  return static_cast<int>(core::Precision::parse(precision).digits());
}

bool has_quad() { return std::string(core::precision_of_34_digits()) == "quad"; }

}  // namespace hbvm
