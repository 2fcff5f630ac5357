#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace hbvm::core {

struct TomlFlaw {
  std::size_t line;
  std::string what;
};

/// What a TOML text must not hold because the parser, toml++ 3.3, would recurse into it without a limit or has no
/// defined behaviour. That is dotted keys of many parts. It is also characters beyond ASCII where only names, numbers
/// and punctuation stand or after a backslash that joins lines.
std::optional<TomlFlaw> find_flaw(std::string_view text);

}  // namespace hbvm::core
