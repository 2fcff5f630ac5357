#pragma once

#include <string>

#include "hbvm/section.hpp"

namespace hbvm::core {

/// "a.x = 0, upwards"
std::string crossing_text(const Section& section);

/// The points, a colour an orbit; colours come again after nine.
Figure section_figure(const Section& section);

}  // namespace hbvm::core
