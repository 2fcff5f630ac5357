#pragma once

#include "hbvm/section.hpp"

namespace hbvm::core {

/// The points, a colour an orbit; colours come again after nine.
Figure section_figure(const Section& section);

}  // namespace hbvm::core
