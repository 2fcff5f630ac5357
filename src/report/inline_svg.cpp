#include "inline_svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>
#include <vector>

#include "hbvm/error.hpp"
#include "html.hpp"

namespace hbvm::core {
namespace {

constexpr std::array<std::string_view, 20> drawing_elements{
    "svg",     "g",      "defs",    "path",    "text",     "tspan",          "rect",           "circle",
    "ellipse", "line",   "polygon", "use",     "polyline", "linearGradient", "radialGradient", "stop",
    "symbol",  "marker", "pattern", "clipPath"};

bool draws(std::string_view name) {
  return std::find(drawing_elements.begin(), drawing_elements.end(), name) != drawing_elements.end();
}

bool is_name(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_' || c == ':'; }

struct Attribute {
  std::string name, value;
};

/// A tag between < and >.
struct Tag {
  std::string name;
  std::vector<Attribute> attributes;
  bool closes = false, is_empty = false;
};

class Reader {
 public:
  Reader(const std::string& text, std::string prefix, const std::string& file)
      : text_(text), prefix_(std::move(prefix)), file_(file) {}

  InlineSvg read() {
    while (at_ < text_.size()) {
      const std::size_t begin = std::min(text_.find('<', at_), text_.size());
      words(std::string_view(text_).substr(at_, begin - at_));
      at_ = begin;
      if (at_ == text_.size()) break;
      if (skipped("<!--", "-->") || skipped("<?", "?>") || character_data() || skipped("<!", ">")) continue;
      element(tag());
    }
    if (!open_.empty()) fail("<" + open_.back() + "> does not end");
    if (result_.svg.empty()) fail("no drawing: there is no <svg>");
    return std::move(result_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    const auto lines = std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(at_), '\n');
    throw InputError(fmt::format("{}:{}: {}", file_, lines + 1, what));
  }

  bool is_kept() const { return dropped_ == 0 && !open_.empty(); }
  bool is_data() const { return !open_.empty() && open_.back() == data_element; }

  void words(std::string_view text) {
    if (is_data())
      result_.data += text;
    else if (is_kept())
      result_.svg += text;
  }

  bool skipped(std::string_view begin, std::string_view end) {
    if (!std::string_view(text_).substr(at_).starts_with(begin)) return false;
    const std::size_t found = text_.find(end, at_ + begin.size());
    if (found == std::string::npos) fail(std::string(begin) + " does not end");
    at_ = found + end.size();
    return true;
  }

  bool character_data() {
    constexpr std::string_view begin = "<![CDATA[";
    const std::size_t from = at_ + begin.size();
    if (!skipped(begin, "]]>")) return false;
    if (is_kept()) result_.svg += html(std::string_view(text_).substr(from, at_ - 3 - from));
    return true;
  }

  std::string name() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && is_name(text_[at_])) ++at_;
    if (at_ == begin) fail("a name was expected");
    return text_.substr(begin, at_ - begin);
  }

  void space() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) != 0) ++at_;
  }

  Tag tag() {
    Tag tag;
    ++at_;
    if (at_ < text_.size() && text_[at_] == '/') {
      tag.closes = true;
      ++at_;
    }
    tag.name = name();
    for (;;) {
      space();
      if (at_ >= text_.size()) fail("<" + tag.name + " does not end");
      if (text_[at_] == '>') break;
      if (text_[at_] == '/') {
        tag.is_empty = true;
        ++at_;
        continue;
      }
      Attribute attribute{name(), {}};
      space();
      if (at_ >= text_.size() || text_[at_] != '=') fail("attribute " + attribute.name + " has no value");
      ++at_;
      space();
      const char quote = at_ < text_.size() ? text_[at_] : ' ';
      const std::size_t end = quote == '"' || quote == '\'' ? text_.find(quote, at_ + 1) : std::string::npos;
      if (end == std::string::npos) fail("the value of " + attribute.name + " has no quotes");
      attribute.value = text_.substr(at_ + 1, end - at_ - 1);
      at_ = end + 1;
      tag.attributes.push_back(std::move(attribute));
    }
    ++at_;
    return tag;
  }

  void element(const Tag& tag) {
    if (tag.closes) {
      if (open_.empty() || (open_.back() != tag.name && !(is_data() && tag.name == "metadata")))
        fail("</" + tag.name + "> ends nothing");
      open_.pop_back();
      if (dropped_ > 0)
        --dropped_;
      else
        result_.svg += "</" + tag.name + ">";
      return;
    }
    if (open_.empty() && (tag.name != "svg" || !result_.svg.empty()))
      fail("<svg> was expected, not <" + tag.name + ">");
    const bool is_figure =
        tag.name == "metadata" && std::any_of(tag.attributes.begin(), tag.attributes.end(),
                                              [](const Attribute& a) { return a.value == "hbvm-figure"; });
    const bool kept = dropped_ == 0 && draws(tag.name);
    if (kept) {
      result_.svg += "<" + tag.name;
      for (const Attribute& attribute : tag.attributes) {
        add(attribute);
        if (open_.empty() && attribute.name == "width") add_most_width(attribute.value);
      }
      result_.svg += tag.is_empty ? "/>" : ">";
    }
    if (tag.is_empty) return;
    if (!kept) ++dropped_;
    open_.push_back(is_figure ? data_element : tag.name);
  }

  /// Every #name within it is one of this drawing.
  std::string own_names(const std::string& value) const {
    std::string result;
    for (const char c : value) result += c == '#' ? "#" + prefix_ : std::string(1, c);
    return result;
  }

  void add(const Attribute& attribute) {
    std::string name = attribute.name, value = attribute.value, plain;
    std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
    for (const char c : value)
      if (std::isspace(static_cast<unsigned char>(c)) == 0)
        plain += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (name.starts_with("on") || name.starts_with("xmlns:") || name == "style" || name == "class") return;
    // What would be read as another text once entities are resolved is left out, too.
    if (name == "href" || name == "xlink:href") {
      if (!plain.starts_with('#') || plain.find('&') != std::string::npos) return;
      value = own_names(value);
    } else if (plain.find("url") != std::string::npos || plain.find("script") != std::string::npos) {
      if (!plain.starts_with("url(#") || plain.find('&') != std::string::npos) return;
      value = own_names(value);
    } else if (name == "id") {
      value = prefix_ + value;
    }
    std::string quoted;
    for (const char c : value)
      quoted += c == '"' ? std::string("&quot;") : c == '<' ? std::string("&lt;") : std::string(1, c);
    result_.svg += " " + attribute.name + "=\"" + quoted + "\"";
  }

  /// It is drawn smaller where there is no room for it, and never larger.
  void add_most_width(const std::string& value) {
    const bool is_number = !value.empty() && value.find_first_not_of("0123456789.") == std::string::npos;
    if (is_number) result_.svg += " style=\"max-width:" + value + "px\"";
  }

  static constexpr const char* data_element = "metadata of hbvm";

  const std::string& text_;
  std::string prefix_;
  const std::string& file_;
  std::size_t at_ = 0;
  std::vector<std::string> open_;
  int dropped_ = 0;  ///< elements that are open and not kept
  InlineSvg result_;
};

std::string without_entities(std::string text) {
  for (const auto& [entity, letter] : {std::pair{"&lt;", "<"}, {"&gt;", ">"}, {"&amp;", "&"}})
    for (std::size_t at = 0; (at = text.find(entity, at)) != std::string::npos; ++at)
      text.replace(at, std::string_view(entity).size(), letter);
  return text;
}

}  // namespace

InlineSvg inline_svg(const std::string& text, const std::string& prefix, const std::string& file) {
  InlineSvg result = Reader(text, prefix, file).read();
  result.data = without_entities(result.data);
  return result;
}

}  // namespace hbvm::core
