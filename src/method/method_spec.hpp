#pragma once

#include <string>
#include <string_view>

namespace hbvm::core {

/// A method as a user names it: a family and its arguments, "hbvm:4,2", "rattle", "tableau:FILE". What the arguments
/// mean is the family's to say, see step/registry.hpp.
struct MethodSpec {
  std::string family, arguments;

  /// Splits at the first colon.
  static MethodSpec parse(std::string_view text) {
    const std::size_t colon = text.find(':');
    if (colon == std::string_view::npos) return {std::string(text), {}};
    return {std::string(text.substr(0, colon)), std::string(text.substr(colon + 1))};
  }
  std::string text() const { return arguments.empty() ? family : family + ":" + arguments; }
};

}  // namespace hbvm::core
