#include "json_lines.hpp"

#include <cmath>
#include <istream>
#include <limits>

#include "hbvm/version.hpp"

namespace hbvm {

OrderedJson json_number(double x) { return std::isfinite(x) ? OrderedJson(x) : OrderedJson(nullptr); }

double number_of(const OrderedJson& json) {
  return json.is_null() ? std::numeric_limits<double>::quiet_NaN() : json.get<double>();
}

std::string dumped(const OrderedJson& json, int indent) {
  return json.dump(indent, ' ', false, OrderedJson::error_handler_t::replace);
}

std::string finding_line(const std::string& key, const OrderedJson& finding) {
  return dumped({{"key", key}, {"version", version()}, {"finding", finding}}, -1);
}

void read_finding_lines(std::istream& lines, const std::function<void(const std::string&, const OrderedJson&)>& take) {
  for (std::string line; std::getline(lines, line);) {
    try {
      const OrderedJson json = OrderedJson::parse(line);
      if (json.at("version") == version()) take(json.at("key"), json.at("finding"));
    } catch (const OrderedJson::exception&) {
      continue;  // cut off
    }
  }
}

}  // namespace hbvm
