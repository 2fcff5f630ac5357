#include "html.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace hbvm::core {

std::string html(std::string_view text) {
  constexpr std::pair<char, std::string_view> entities[] = {
      {'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}, {'\'', "&#39;"}};
  std::string result;
  for (const char c : text) {
    const auto* const found =
        std::find_if(std::begin(entities), std::end(entities), [c](const auto& e) { return e.first == c; });
    result += found == std::end(entities) ? std::string_view(&c, 1) : found->second;
  }
  return result;
}

std::string within_script(std::string_view json) {
  std::string result;
  for (const char c : json) result += c == '<' ? std::string("\\u003c") : std::string(1, c);
  return result;
}

std::string percent_encoded(std::string_view text, std::string_view further) {
  const std::string_view digits = "0123456789ABCDEF";
  std::string result;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const bool is_word = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
    if (is_word || further.find(c) != std::string_view::npos)
      result += c;
    else
      result += {'%', digits[byte / 16], digits[byte % 16]};
  }
  return result;
}

}  // namespace hbvm::core
