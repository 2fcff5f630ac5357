#pragma once

#include <charconv>
#include <optional>
#include <string>
#include <string_view>

namespace hbvm::core {

/// A method as a user names it: a family and its arguments, "hbvm:4,2", "rattle", "rk4+project". What the arguments
/// mean is the family's to say, see step/registry.hpp.
struct MethodSpec {
  std::string family, arguments;

  /// Splits at the first colon, or before the first plus if that comes earlier.
  static MethodSpec parse(std::string_view text) {
    const std::size_t end = text.find_first_of(":+");
    if (end == std::string_view::npos) return {std::string(text), {}};
    return {std::string(text.substr(0, end)), std::string(text.substr(text[end] == ':' ? end + 1 : end))};
  }
  std::string text() const {
    return arguments.empty() || arguments.front() == '+' ? family + arguments : family + ":" + arguments;
  }
};

/// An argument that is a whole number and nothing else.
inline std::optional<int> whole_number(std::string_view text) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (text.empty() || error != std::errc() || end != text.data() + text.size()) return {};
  return number;
}

}  // namespace hbvm::core
