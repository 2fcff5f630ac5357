#include "svg_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "hbvm/error.hpp"
#include "report/html.hpp"

namespace hbvm::core {
namespace {

std::string without_entities(std::string text) {
  for (const auto& [entity, letter] : {std::pair{"&lt;", "<"}, {"&gt;", ">"}, {"&amp;", "&"}})
    for (std::size_t at = 0; (at = text.find(entity, at)) != std::string::npos; ++at)
      text.replace(at, std::string_view(entity).size(), letter);
  return text;
}

}  // namespace

SvgPicture svg_picture(const std::string& text, const std::string& file) {
  if (text.find("<svg") == std::string::npos) throw InputError(file + ":1: no drawing: there is no <svg>");
  if (text.find("</svg>") == std::string::npos) {
    const auto lines = std::count(text.begin(), text.end(), '\n');
    throw InputError(fmt::format("{}:{}: <svg> does not end", file, lines + 1));
  }
  constexpr std::string_view begin = "<metadata id=\"hbvm-figure\">", end = "</metadata>";
  std::string drawing = text, data;
  const std::size_t from = text.find(begin), to = text.find(end, from);
  if (to != std::string::npos) {
    data = without_entities(text.substr(from + begin.size(), to - from - begin.size()));
    drawing.erase(from, to + end.size() - from);
  }
  return {"data:image/svg+xml," + percent_encoded(drawing, " !$()*+,-./:;=?@~"), data};
}

}  // namespace hbvm::core
