#include "markdown.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <sstream>
#include <vector>

#include "html.hpp"

namespace hbvm::core {
namespace {

std::string stripped(const std::string& text) {
  const auto begin = text.find_first_not_of(" \t\r");
  return begin == std::string::npos ? "" : text.substr(begin, text.find_last_not_of(" \t\r") + 1 - begin);
}

/// What a line begins with that makes it an entry of a list: its length, or 0.
std::size_t bullet_of(const std::string& line) {
  if (line.starts_with("- ") || line.starts_with("* ")) return 2;
  std::size_t digits = 0;
  while (digits < line.size() && std::isdigit(static_cast<unsigned char>(line[digits])) != 0) ++digits;
  return digits > 0 && line.substr(digits, 2) == ". " ? digits + 2 : 0;
}

class Markdown {
 public:
  Markdown(const std::string& text, const PictureOf& picture) : picture_(picture) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) lines_.push_back(line);
  }

  std::string html_text() {
    while (at_ < lines_.size()) block();
    return std::move(result_);
  }

 private:
  void block() {
    const std::string& line = lines_[at_];
    const std::string text = stripped(line);
    if (text.empty())
      ++at_;
    else if (text.starts_with("<!--"))
      comment();
    else if (text.starts_with("```"))
      fenced();
    else if (line.starts_with("    "))
      indented();
    else if (line.starts_with("#"))
      heading();
    else if (is_table(at_))
      table();
    else if (bullet_of(line) > 0)
      list();
    else
      result_ += "<p>" + words(paragraph(at_)) + "</p>\n";
  }

  void comment() {
    while (at_ < lines_.size() && lines_[at_].find("-->") == std::string::npos) ++at_;
    ++at_;
  }

  void fenced() {
    std::string code;
    for (++at_; at_ < lines_.size() && !stripped(lines_[at_]).starts_with("```"); ++at_) code += lines_[at_] + "\n";
    ++at_;
    result_ += "<pre>" + html(code) + "</pre>\n";
  }

  void indented() {
    std::string code;
    for (; at_ < lines_.size() && (lines_[at_].starts_with("    ") || stripped(lines_[at_]).empty()); ++at_)
      code += (lines_[at_].size() > 4 ? lines_[at_].substr(4) : "") + "\n";
    result_ += "<pre>" + html(code.substr(0, code.find_last_not_of('\n') + 1)) + "</pre>\n";
  }

  void heading() {
    const std::string& line = lines_[at_++];
    const std::size_t level = std::min<std::size_t>(line.find_first_not_of('#'), 3) + 2;
    const std::size_t begin = line.find_first_not_of('#');
    result_ +=
        fmt::format("<h{0}>{1}</h{0}>\n", level, words(begin == std::string::npos ? "" : stripped(line.substr(begin))));
  }

  bool is_table(std::size_t at) const {
    if (at + 1 >= lines_.size() || !stripped(lines_[at]).starts_with("|")) return false;
    const std::string rule = stripped(lines_[at + 1]);
    return rule.starts_with("|") && rule.find('-') != std::string::npos &&
           rule.find_first_not_of("|-: ") == std::string::npos;
  }

  static std::vector<std::string> cells(const std::string& line) {
    std::vector<std::string> result;
    std::string cell;
    const std::string text = stripped(line);
    for (std::size_t i = 1; i < text.size(); ++i) {
      if (text[i] == '\\' && i + 1 < text.size() && text[i + 1] == '|') {
        cell += text[++i];
      } else if (text[i] == '|') {
        result.push_back(stripped(cell));
        cell.clear();
      } else {
        cell += text[i];
      }
    }
    if (!stripped(cell).empty()) result.push_back(stripped(cell));
    return result;
  }

  void table() {
    const auto row = [&](const std::string& line, const char* tag) {
      result_ += "<tr>";
      for (const std::string& cell : cells(line)) result_ += fmt::format("<{0}>{1}</{0}>", tag, words(cell));
      result_ += "</tr>\n";
    };
    result_ += "<div class=\"table\"><table>\n<thead>";
    row(lines_[at_], "th");
    result_ += "</thead><tbody>\n";
    for (at_ += 2; at_ < lines_.size() && stripped(lines_[at_]).starts_with("|"); ++at_) row(lines_[at_], "td");
    result_ += "</tbody></table></div>\n";
  }

  void list() {
    const bool ordered = std::isdigit(static_cast<unsigned char>(lines_[at_][0])) != 0;
    const char* const tag = ordered ? "ol" : "ul";
    result_ += fmt::format("<{}>\n", tag);
    while (at_ < lines_.size() && bullet_of(lines_[at_]) > 0)
      result_ += "<li>" + words(paragraph(at_, bullet_of(lines_[at_]))) + "</li>\n";
    result_ += fmt::format("</{}>\n", tag);
  }

  /// Lines that belong together, and where the next begins.
  std::string paragraph(std::size_t& at, std::size_t from = 0) const {
    std::string text = stripped(lines_[at++].substr(from));
    for (; at < lines_.size(); ++at) {
      const std::string next = stripped(lines_[at]);
      if (next.empty() || next.starts_with("#") || next.starts_with("```") || next.starts_with("<!--") ||
          bullet_of(next) > 0 || is_table(at))
        break;
      text += " " + next;
    }
    return text;
  }

  /// Code, stress, links and pictures in a line.
  std::string words(const std::string& text) const {
    std::string result;
    for (std::size_t i = 0; i < text.size();) {
      const auto until = [&](const std::string& end, std::size_t from) { return text.find(end, from); };
      if (text[i] == '`') {
        const std::size_t end = until("`", i + 1);
        if (end != std::string::npos) {
          result += "<code>" + html(text.substr(i + 1, end - i - 1)) + "</code>";
          i = end + 1;
          continue;
        }
      } else if (text.compare(i, 2, "**") == 0) {
        const std::size_t end = until("**", i + 2);
        if (end != std::string::npos && end > i + 2) {
          result += "<strong>" + words(text.substr(i + 2, end - i - 2)) + "</strong>";
          i = end + 2;
          continue;
        }
      } else if (text[i] == '[' || text.compare(i, 2, "![") == 0) {
        const std::size_t open = text.find('[', i), middle = until("](", open), end = until(")", middle);
        if (middle != std::string::npos && end != std::string::npos) {
          const std::string label = text.substr(open + 1, middle - open - 1),
                            address = text.substr(middle + 2, end - middle - 2);
          const std::string picture = text[i] == '!' ? picture_(address) : "";
          if (!picture.empty())
            result += picture;
          else if (text[i] == '[' && (address.starts_with("https://") || address.starts_with("http://")))
            result += "<a href=\"" + html(address) + "\" rel=\"noreferrer\">" + words(label) + "</a>";
          else
            result += words(label);
          i = end + 1;
          continue;
        }
      } else if (text[i] == '\\' && i + 1 < text.size() && std::ispunct(static_cast<unsigned char>(text[i + 1])) != 0) {
        ++i;
      }
      result += html(text.substr(i, 1));
      ++i;
    }
    return result;
  }

  const PictureOf& picture_;
  std::vector<std::string> lines_;
  std::size_t at_ = 0;
  std::string result_;
};

}  // namespace

std::string markdown_html(const std::string& text, const PictureOf& picture) {
  return Markdown(text, picture).html_text();
}

}  // namespace hbvm::core
