#pragma once

#include <algorithm>
#include <cctype>
#include <string>

namespace hbvm::core {

enum class CppPart {
  code,
  comments,
  prose  ///< comments and strings
};

/// One part of C++ text, all else blank: what is left stays in its line and column.
inline std::string only(CppPart part, const std::string& text) {
  const auto in_name = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
  const auto past = [&](const std::string& end, std::size_t from) {
    const std::size_t found = text.find(end, from);
    return found == std::string::npos ? text.size() : found + end.size();
  };
  const auto past_quote = [&](std::size_t at) {
    const char quote = text[at++];
    while (at < text.size() && text[at] != quote) at += text[at] == '\\' ? 2 : 1;
    return std::min(at + 1, text.size());
  };
  std::string result = text;
  const auto past_raw = [&](std::size_t at) {
    const std::size_t open = text.find('(', at);
    const std::string close = ")" + text.substr(at + 2, open - at - 2) + "\"";
    const std::size_t end = past(close, open);
    result[open] = result[end - close.size()] = ' ';  // no brackets of the text
    return end;
  };
  for (std::size_t at = 0, end = 0; at < text.size(); at = end) {
    const bool in_word = at > 0 && in_name(text[at - 1]);
    end = at + 1;
    CppPart found = CppPart::prose;
    if (text.compare(at, 2, "//") == 0 || text.compare(at, 2, "/*") == 0) {
      end = text[at + 1] == '*' ? past("*/", at + 2) : std::min(text.find('\n', at), text.size());
      if (part == CppPart::comments) found = part;
    } else if (text.compare(at, 2, "R\"") == 0 && !in_word)
      end = past_raw(at);
    else if (text[at] == '"' || (text[at] == '\'' && !in_word))  // 1'000 has no quotes
      end = past_quote(at);
    else
      found = CppPart::code;
    if (found != part)
      for (std::size_t i = at; i < end; ++i)
        if (result[i] != '\n') result[i] = ' ';
  }
  return result;
}

}  // namespace hbvm::core
