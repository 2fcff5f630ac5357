#pragma once

#include <string>

namespace hbvm::core {

/// The file section.html, compiled in: @title@, @heading@, @about@, @footer@ and @data@ stand for what a page is of.
const std::string& section_page_text();

}  // namespace hbvm::core
