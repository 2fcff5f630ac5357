#include <fmt/format.h>

#include <cmath>

#include "door/door.hpp"
#include "hbvm/error.hpp"
#include "hbvm/number.hpp"
#include "scalar/literal.hpp"
#include "scalar/text.hpp"
#include "scalar/with_scalar.hpp"

namespace hbvm {

Number::Number(long value) : text_(std::to_string(value)) {}

Number::Number(double value) : text_(fmt::format("{}", value)) {
  if (!std::isfinite(value)) throw InputError("a number of a scene or a run is " + text_ + ": it must be finite");
}

std::string decimal(const Number& number, const std::string& precision) {
  const core::Expression exact = core::expression_of(number, "a number:");
  return core::with_scalar(core::Precision::parse(precision),
                           [&]<core::Scalar S>() { return core::to_text(core::evaluate<S>(exact)); });
}

}  // namespace hbvm
