#include "json.hpp"

#include <cmath>
#include <limits>

namespace hbvm::core {

OrderedJson json_number(double x) { return std::isfinite(x) ? OrderedJson(x) : OrderedJson(nullptr); }

double number_of(const OrderedJson& json) {
  return json.is_null() ? std::numeric_limits<double>::quiet_NaN() : json.get<double>();
}

std::string dumped(const OrderedJson& json, int indent) {
  return json.dump(indent, ' ', false, OrderedJson::error_handler_t::replace);
}

}  // namespace hbvm::core
