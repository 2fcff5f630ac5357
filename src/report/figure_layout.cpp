#include "figure_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

namespace hbvm::core {
namespace {

constexpr double left_of_box = 74, above_box = 34, below_box = 52, least_right_of_box = 18;

PanelPlace ranges_of(const Panel& panel) {
  std::vector<double> x, y;
  const auto gather = [&](const PlotPoint& point) {
    x.push_back(point[0]);
    y.push_back(std::isfinite(point[0]) ? point[1] : NAN);
  };
  for (const Curve& curve : panel.curves) std::for_each(curve.points.begin(), curve.points.end(), gather);
  for (const Polyline& line : panel.lines) std::for_each(line.points.begin(), line.points.end(), gather);
  for (const Mark& mark : panel.marks) gather(mark.at);
  std::for_each(panel.room_for.begin(), panel.room_for.end(), gather);
  for (const Bar& bar : panel.bars) {
    gather({bar.x - double{1} / 2, bar.from});
    gather({bar.x + double{1} / 2, bar.to});
  }
  PanelPlace place{0, 0, range_of(x, panel.x.scale), range_of(y, panel.y.scale)};
  constexpr double room = 0.04;
  if (panel.equal_axes) {
    const double unit = (1 + 2 * room) * std::max(place.x.length() / box_width, place.y.length() / box_height);
    const auto about = [&](const AxisRange& range, double pixels) {
      const double middle = (range.from + range.to) / 2;
      return AxisRange{middle - unit * pixels / 2, middle + unit * pixels / 2};
    };
    place.x = about(place.x, box_width);
    place.y = about(place.y, box_height);
  } else if (panel.bars.empty()) {
    place.y = widened(place.y, room);
  }
  if (panel.round_off) place.y = ended_at_round_off(place.y, *panel.round_off);
  if (panel.x.scale == AxisScale::binary) place.x = widened(place.x, room);
  return place;
}

/// Words of a figure as they are read: what lowers, raises and joins is for the eye alone.
std::string read_words(const std::string& text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\\' && i + 1 < text.size())
      result += text[++i];
    else if (text[i] != '{' && text[i] != '}')
      result += text[i];
  }
  return result;
}

/// What the labels at the right of its curves need, in pixels.
double right_of(const Panel& panel) {
  std::size_t longest = 0;
  bool marked = false;
  if (has_names(panel))
    for (const Curve& curve : panel.curves) {
      longest = std::max(longest, letters(read_words(curve.label)));
      marked = marked || (panel.labels_beside && curve.marked);
    }
  // The label of the next panel's axis stands at the edge, and a wide letter takes more than the usual width.
  constexpr double mark = 12, wide = 7.2, beside_edge = 12;
  const double before = (panel.labels_beside ? 10 + beside_edge : 10) + (marked ? mark : 0);
  const double width = panel.labels_beside ? wide : letter_width;
  return longest > 0 ? before + width * static_cast<double>(longest) : 0;
}

using Json = nlohmann::ordered_json;

const char* name_of(AxisScale scale) {
  return scale == AxisScale::binary    ? "binary"
         : scale == AxisScale::decimal ? "decimal"
         : scale == AxisScale::falling ? "falling"
                                       : "linear";
}

Json json_of(const Axis& axis, const AxisRange& range) {
  Json json{{"label", read_words(axis.label)}, {"scale", name_of(axis.scale)}, {"from", range.from}, {"to", range.to}};
  if (!axis.names.empty()) json["names"] = axis.names;
  return json;
}

/// No more digits than are drawn.
double rounded(double x) { return std::strtod(fmt::format("{:.7g}", x).c_str(), nullptr); }

/// Words in lines of a figure of that width; a word longer than a line is cut.
std::vector<std::string> lines_of(const std::string& footnote, double width) {
  constexpr double small_letter = 5.3, margins = 24;
  const auto most = static_cast<std::size_t>(std::max(1.0, (width - margins) / small_letter));
  std::vector<std::string> lines;
  std::string rest = footnote;
  while (letters(rest) > most) {
    std::size_t cut = rest.rfind(' ', most);
    if (cut == std::string::npos || cut == 0) cut = most;
    lines.push_back(rest.substr(0, cut));
    rest = rest.substr(rest[cut] == ' ' ? cut + 1 : cut);
  }
  if (!rest.empty()) lines.push_back(rest);
  return lines;
}

}  // namespace

std::size_t letters(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

bool has_names(const Panel& panel) {
  constexpr std::size_t most = 24;
  return panel.curves.size() > (panel.labels_beside ? 0 : 1) && panel.curves.size() <= most;
}

FigureLayout layout_of(const Figure& figure) {
  const std::size_t count = figure.panels.size(), columns = std::min<std::size_t>(count, 2),
                    rows = columns > 0 ? (count + columns - 1) / columns : 0;
  double right = least_right_of_box;
  for (const Panel& panel : figure.panels) right = std::max(right, right_of(panel));
  const double width = left_of_box + box_width + right, height = above_box + box_height + below_box;
  const double across = static_cast<double>(columns) * width;
  const std::vector<std::string> footnote = lines_of(figure.footnote, across);
  const double top = figure.caption.empty() ? 0 : title_height,
               foot = footnote.empty() ? 0 : footnote_height + line_height * static_cast<double>(footnote.size() - 1);
  FigureLayout layout{{across, static_cast<double>(rows) * height + top + foot}, {}, footnote};
  for (std::size_t i = 0; i < count; ++i) {
    PanelPlace place = ranges_of(figure.panels[i]);
    const std::size_t row = i / columns;
    place.left = static_cast<double>(i % columns) * width + left_of_box;
    place.bottom = foot + static_cast<double>(rows - 1 - row) * height + below_box;
    layout.panels.push_back(place);
  }
  return layout;
}

std::string figure_data(const Figure& figure) {
  const FigureLayout layout = layout_of(figure);
  Json json{{"size", layout.size}};
  for (std::size_t i = 0; i < figure.panels.size(); ++i) {
    const Panel& panel = figure.panels[i];
    const PanelPlace& place = layout.panels[i];
    Json curves = Json::array();
    const auto add = [&](const std::string& label, const std::vector<PlotPoint>& points) {
      Json list = Json::array();
      for (const PlotPoint& point : points)
        if (std::isfinite(point[0]) && std::isfinite(point[1])) list.push_back({rounded(point[0]), rounded(point[1])});
      if (!list.empty()) curves.push_back({{"label", read_words(label)}, {"points", list}});
    };
    if (panel.bars.empty())
      for (const Curve& curve : panel.curves) add(curve.label, curve.points);
    for (const Bar& bar : panel.bars) {
      const bool named = bar.colour < panel.curves.size();
      Json one{{"label", named ? read_words(panel.curves[bar.colour].label) : ""},
               {"points", Json::array({{bar.x, rounded((bar.from + bar.to) / 2)}})},
               {"value", rounded(bar.to - bar.from)}};
      curves.push_back(one);
    }
    for (const Mark& mark : panel.marks) add(mark.label, {mark.at});
    json["panels"].push_back({{"title", read_words(panel.title)},
                              {"box", {place.left, layout.size[1] - place.bottom - box_height, box_width, box_height}},
                              {"x", json_of(panel.x, place.x)},
                              {"y", json_of(panel.y, place.y)},
                              {"curves", curves}});
  }
  return json.dump();
}

}  // namespace hbvm::core
