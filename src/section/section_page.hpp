#pragma once

#include <string>

#include "section/run_section.hpp"

namespace hbvm::core {

/// A page of HTML that needs nothing besides itself. A click on a point shows the other points of its orbit, its start,
/// and where the bodies go in its first four hundred steps.
/// \throws InputError, IntegrationError of these steps; Interrupted
std::string section_page(const Section& section, const SectionWork& work);

}  // namespace hbvm::core
