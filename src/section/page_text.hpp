#pragma once

#include <string>

namespace hbvm::core {

/// The file section.html, compiled in. Words between two at signs stand for what a page is of: title, heading, about,
/// footer and data.
const std::string& section_page_text();

}  // namespace hbvm::core
