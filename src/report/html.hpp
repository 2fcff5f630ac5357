#pragma once

#include <string>
#include <string_view>

namespace hbvm::core {

/// Text within HTML, also within an attribute.
std::string html(std::string_view text);

/// JSON within a script: no text in it can end the script, or begin a comment in it.
std::string within_script(std::string_view json);

/// Text within an address: other characters than letters, digits, "_" and those of `further` as %XX.
std::string percent_encoded(std::string_view text, std::string_view further);

}  // namespace hbvm::core
