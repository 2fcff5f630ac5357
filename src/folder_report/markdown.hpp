#pragma once

#include <functional>
#include <string>

namespace hbvm::core {

/// What stands for a picture, by its address; nothing if there is none.
using PictureOf = std::function<std::string(const std::string& address)>;

/// The Markdown that hbvm and its studies write, as HTML: headings (below those of the page), paragraphs, lists, tables
/// and code. In them are code, stress, links to the web and pictures. All text is escaped; comments are left out.
std::string markdown_html(const std::string& text, const PictureOf& picture);

}  // namespace hbvm::core
