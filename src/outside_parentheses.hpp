#pragma once

#include <string>
#include <vector>

namespace hbvm::core {

/// The first place of a character from `from` on that is in no parentheses, or npos.
inline std::size_t find_outside_parentheses(const std::string& text, char what, std::size_t from = 0) {
  int open = 0;
  for (std::size_t i = from; i < text.size(); ++i) {
    open += text[i] == '(' ? 1 : text[i] == ')' ? -1 : 0;
    if (text[i] == what && open == 0) return i;
  }
  return std::string::npos;
}

/// The parts of a text between such characters.
inline std::vector<std::string> split_outside_parentheses(const std::string& text, char at) {
  std::vector<std::string> parts;
  std::size_t from = 0;
  for (std::size_t end; (end = find_outside_parentheses(text, at, from)) != std::string::npos; from = end + 1)
    parts.push_back(text.substr(from, end - from));
  parts.push_back(text.substr(from));
  return parts;
}

}  // namespace hbvm::core
