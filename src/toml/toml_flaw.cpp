#include "toml/toml_flaw.hpp"

#include <algorithm>

namespace hbvm::core {
namespace {

/// Walks over the text and tells strings and comments from the rest, as the parser does as long as it goes on.
class Walk {
 public:
  explicit Walk(std::string_view text) : text_(text) {}

  std::optional<TomlFlaw> find() {
    while (at_ < text_.size() && !flaw_) {
      const char c = text_[at_];
      if (c == '#')
        at_ = std::min(text_.find('\n', at_), text_.size());
      else if (c == '"' || c == '\'')
        string(c);
      else
        outside(c);
    }
    return flaw_;
  }

 private:
  void flaw(std::string what) {
    const auto line = 1 + std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(at_), '\n');
    flaw_ = {static_cast<std::size_t>(line), std::move(what)};
  }

  bool beyond_ascii() const { return at_ < text_.size() && static_cast<unsigned char>(text_[at_]) >= 0x80; }
  void refuse_beyond_ascii() {
    if (beyond_ascii()) flaw("characters beyond ASCII may stand in quotes and comments only");
  }
  /// Whether the character before is one of these, or there is none.
  bool follows(std::string_view characters) const {
    return at_ == 0 || characters.find(text_[at_ - 1]) != std::string_view::npos;
  }

  void outside(char c) {
    constexpr int limit = 64;
    constexpr std::string_view ends = "=\n,[]{}";  // of a key
    if (ends.find(c) != std::string_view::npos) dots_ = 0;
    if (c == '.' && ++dots_ > limit) flaw("a dotted key has more than " + std::to_string(limit) + " parts");
    refuse_beyond_ascii();
    // The parser reads on to the end of a word: where one goes on with a bracket, '=' or quote, it sees no string.
    if (c == '=') {
      if (in_value_ || open_.ends_with('[')) flaw("'=' does not fit here");
      in_value_ = true;
    } else if (c == '[' || c == '{') {
      if (!follows(" \t\r\n,=[{")) flaw("'" + std::string(1, c) + "' does not fit here");
      open_ += c;
      in_value_ = false;
    } else if (c == ']' || c == '}') {
      if (!open_.empty()) open_.pop_back();
      in_value_ = true;
    } else if (c == ',' || (c == '\n' && open_.empty())) {
      in_value_ = false;
    }
    ++at_;
  }

  /// From the opening quote to behind the closing one, or to the end of the line that lacks it.
  void string(char quote) {
    if (!follows(" \t\r\n,=[{.")) flaw("a quote does not fit here");
    const bool dotted = at_ > 0 && text_[at_ - 1] == '.';
    const std::string three(3, quote);
    const bool multi_line = text_.substr(at_).starts_with(three);
    at_ += multi_line ? 3 : 1;
    while (at_ < text_.size() && !flaw_) {
      const char c = text_[at_];
      if (c == '\n' && !multi_line) return;
      if (dotted) refuse_beyond_ascii();
      if (c == '\\' && quote == '"') {
        escape(multi_line);
      } else if (c == quote && (!multi_line || text_.substr(at_).starts_with(three))) {
        at_ += multi_line ? 3 : 1;
        // A string of several lines may end with two more quotes of its own.
        for (int more = 0; multi_line && more < 2 && at_ < text_.size() && text_[at_] == quote; ++more) ++at_;
        return;
      } else {
        ++at_;
      }
    }
  }

  void escape(bool multi_line) {
    ++at_;
    if (!multi_line) {
      ++at_;
      return;
    }
    const std::size_t blanks = std::min(text_.find_first_not_of(" \t\r\n", at_), text_.size()) - at_;
    at_ += blanks;
    if (beyond_ascii()) flaw("a character beyond ASCII must not follow a backslash that joins lines");
    if (blanks == 0) ++at_;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  int dots_ = 0;
  std::string open_;       // brackets
  bool in_value_ = false;  // behind the '=' of a pair
  std::optional<TomlFlaw> flaw_;
};

}  // namespace

std::optional<TomlFlaw> find_flaw(std::string_view text) { return Walk(text).find(); }

}  // namespace hbvm::core
