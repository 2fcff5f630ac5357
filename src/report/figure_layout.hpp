#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "axis_range.hpp"
#include "hbvm/figure.hpp"

namespace hbvm::core {

/// In pixels of an SVG.
inline constexpr double box_width = 330, box_height = 270;
inline constexpr double letter_width = 6.6, line_height = 14, title_height = 26, footnote_height = 20;

/// The box of a panel, in pixels from the left and from below, and what of its axes is shown there.
struct PanelPlace {
  double left, bottom;
  AxisRange x, y;
};

struct FigureLayout {
  PlotPoint size;  ///< in pixels
  std::vector<PanelPlace> panels;
  std::vector<std::string> footnote;  ///< in lines that are no longer than the figure is wide
};

FigureLayout layout_of(const Figure& figure);

/// Whether its curves have their names beside them: not the only one, nor more than have room.
bool has_names(const Panel& panel);

/// How many letters are seen of UTF-8.
std::size_t letters(const std::string& text);

/// What a drawing of the figure says of itself, as JSON. It is {"size": [width, height], "panels": [{"title", "box":
/// [left, top, width, height], "x": {"label", "scale", "from", "to"}, "y": likewise, "curves": [{"label", "points":
/// [[x, y], ...]}]}]}. Bars are a curve of their own, names of an axis its "names". Scales are named as AxisScale does.
std::string figure_data(const Figure& figure);

}  // namespace hbvm::core
