#include "markdown.hpp"

#include <fmt/format.h>
#include <md4c.h>

#include <algorithm>

#include "report/html.hpp"

namespace hbvm::core {
namespace {

/// What a part of the text begins and ends with on the page.
template <class Type>
struct Tags {
  Type type;
  const char *begin, *end;
};
constexpr Tags<MD_BLOCKTYPE> blocks[] = {{MD_BLOCK_P, "<p>", "</p>\n"},
                                         {MD_BLOCK_UL, "<ul>\n", "</ul>\n"},
                                         {MD_BLOCK_OL, "<ol>\n", "</ol>\n"},
                                         {MD_BLOCK_LI, "<li>", "</li>\n"},
                                         {MD_BLOCK_QUOTE, "<blockquote>\n", "</blockquote>\n"},
                                         {MD_BLOCK_HR, "<hr>\n", ""},
                                         {MD_BLOCK_CODE, "<pre>", "</pre>\n"},
                                         {MD_BLOCK_TABLE, "<div class=\"table\"><table>\n", "</table></div>\n"},
                                         {MD_BLOCK_THEAD, "<thead>", "</thead>"},
                                         {MD_BLOCK_TBODY, "<tbody>\n", "</tbody>"},
                                         {MD_BLOCK_TR, "<tr>", "</tr>\n"},
                                         {MD_BLOCK_TH, "<th>", "</th>"},
                                         {MD_BLOCK_TD, "<td>", "</td>"}};
constexpr Tags<MD_SPANTYPE> spans[] = {
    {MD_SPAN_CODE, "<code>", "</code>"}, {MD_SPAN_STRONG, "<strong>", "</strong>"}, {MD_SPAN_EM, "<em>", "</em>"}};

/// The HTML of what the library reads.
struct Page {
  const PictureOf& picture;
  std::string html;
  bool is_drawn = false;  ///< a picture, whose words are then left out
};

template <bool begins>
int block(MD_BLOCKTYPE type, void* detail, void* page) {
  std::string& html = static_cast<Page*>(page)->html;
  for (const auto& tags : blocks)
    if (tags.type == type) html += begins ? tags.begin : tags.end;
  if (type == MD_BLOCK_H) {
    const unsigned level = std::min(static_cast<const MD_BLOCK_H_DETAIL*>(detail)->level, 3U) + 2;
    html += begins ? fmt::format("<h{}>", level) : fmt::format("</h{}>\n", level);
  }
  return 0;
}

template <bool begins>
int span(MD_SPANTYPE type, void* detail, void* page) {
  auto& [picture, result, is_drawn] = *static_cast<Page*>(page);
  for (const auto& tags : spans)
    if (tags.type == type) result += begins ? tags.begin : tags.end;
  if (type == MD_SPAN_A) {
    const MD_ATTRIBUTE& href = static_cast<const MD_SPAN_A_DETAIL*>(detail)->href;
    const std::string_view address(href.text, href.size);
    if (address.starts_with("https://") || address.starts_with("http://"))
      result += begins ? "<a href=\"" + html(address) + "\" rel=\"noreferrer\">" : "</a>";
  }
  if (type == MD_SPAN_IMG) {
    const MD_ATTRIBUTE& source = static_cast<const MD_SPAN_IMG_DETAIL*>(detail)->src;
    const std::string drawn = begins ? picture(std::string(source.text, source.size)) : "";
    is_drawn = !drawn.empty();
    result += drawn;
  }
  return 0;
}

int words(MD_TEXTTYPE type, const char* text, MD_SIZE size, void* page) {
  if (static_cast<Page*>(page)->is_drawn) return 0;
  const bool is_space = type == MD_TEXT_SOFTBR || type == MD_TEXT_BR;
  static_cast<Page*>(page)->html += is_space ? " " : html({text, size});
  return 0;
}

}  // namespace

std::string markdown_html(const std::string& text, const PictureOf& picture) {
  std::string shown = text;
  for (std::size_t at = 0; (at = shown.find("<!--", at)) != std::string::npos;)
    shown.erase(at, std::min(shown.find("-->", at), shown.size()) + 3 - at);
  Page page{picture, {}};
  const MD_PARSER reader{
      0, MD_FLAG_TABLES | MD_FLAG_NOHTML, block<true>, block<false>, span<true>, span<false>, words, nullptr, nullptr};
  md_parse(shown.data(), static_cast<MD_SIZE>(shown.size()), &reader, &page);
  return page.html;
}

}  // namespace hbvm::core
