#include <fmt/format.h>

#include <cmath>

#include "hbvm/error.hpp"
#include "hbvm/number.hpp"

namespace hbvm {

Number::Number(long value) : text_(std::to_string(value)) {}

Number::Number(double value) : text_(fmt::format("{}", value)) {
  if (!std::isfinite(value)) throw InputError("a number of a scene or a run is " + text_ + ": it must be finite");
}

}  // namespace hbvm
