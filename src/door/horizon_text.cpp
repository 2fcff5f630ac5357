#include "door/horizon_text.hpp"

#include <fmt/format.h>

namespace hbvm::core {

std::string line_of(const Horizon& horizon, const std::string& keeps) {
  if (!horizon.t) return fmt::format("  {:<10} keeps digits{}\n", horizon.precision, keeps);
  return fmt::format("  {:<10} has no digit left at t = {:.4g}{}\n", horizon.precision, *horizon.t,
                     horizon.extrapolated ? ", if it goes on so" : "");
}

OrderedJson json_of(const Horizon& horizon) {
  return {{"precision", horizon.precision},
          {"digits", horizon.digits},
          {"t", horizon.t ? json_number(*horizon.t) : OrderedJson(nullptr)},
          {"extrapolated", horizon.extrapolated}};
}

}  // namespace hbvm::core
