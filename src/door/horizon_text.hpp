#pragma once

#include <string>

#include "hbvm/horizon.hpp"
#include "long_work/json.hpp"

namespace hbvm::core {

/// A line for people. \param keeps why digits are kept, where no time is known at which none is left
std::string line_of(const Horizon& horizon, const std::string& keeps);
/// {"precision", "digits", "t", "extrapolated"}
OrderedJson json_of(const Horizon& horizon);

}  // namespace hbvm::core
