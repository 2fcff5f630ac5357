#pragma once

#include "scene/scene_text.hpp"

namespace hbvm::core {

/// That a message begins with `where`, and holds the words.
inline void expect_message(const std::string& message, const std::string& where,
                           const std::vector<std::string>& words) {
  EXPECT_TRUE(message.starts_with(where)) << "not at " << where << " but: " << message;
  for (const std::string& word : words) expect_words(message, {word});
}

/// The line that a change stands in, and that of the header of its table.
inline constexpr std::string_view here = "", its_table = "[";

/// `from` in a scene replaced by `to`, what its refusal must say, and at the line of what.
struct WrongChange {
  const char *from, *to;
  std::vector<std::string> words;
  std::string_view at = here;
};

/// That `refusal_of` a scene with each of these changes names the file, the line and the words.
template <class RefusalOf>
void expect_refusals(const RefusalOf& refusal_of, const std::string& scene, const std::vector<WrongChange>& changes) {
  for (const auto& [from, to, words, at] : changes) {
    SCOPED_TRACE(std::string(from) + " -> " + to);
    const std::string text = changed(scene, from, to);
    const auto first = static_cast<std::size_t>(std::ranges::mismatch(text, scene).in1 - text.begin());
    const std::size_t place = at == here        ? first
                              : at == its_table ? text.substr(0, first).rfind("\n[") + 1
                                                : text.find(at);
    const auto line = 1 + std::ranges::count(text.substr(0, place), '\n');
    expect_message(refusal_of(text), "test.toml:" + std::to_string(line) + ": ", words);
  }
}

}  // namespace hbvm::core
