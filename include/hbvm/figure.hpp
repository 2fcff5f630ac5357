#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hbvm {

/// How far numbers are apart on an axis.
enum class AxisScale {
  linear,
  binary,   ///< a coordinate is log2 of the number that is shown
  decimal,  ///< log10 of it: numbers beyond the range of double have a place, too
  falling   ///< -log10 of it: errors that fall to the right
};

struct Axis {
  std::string label;
  AxisScale scale = AxisScale::linear;
  /// Instead of numbers: the words at 0, 1, 2 ...
  std::vector<std::string> names = {};
};

/// The colours of curves, one after another: Okabe and Ito's, told apart by all eyes. Then come three that differ from
/// these by how dark they are. Black is for what is no curve.
inline constexpr std::array<std::string_view, 9> curve_colours{"#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00",
                                                               "#56B4E9", "#5B2A86", "#7A4A1E", "#7F7F7F"};

using PlotPoint = std::array<double, 2>;

/// A line through points in the order given; where a coordinate is not finite it is interrupted.
struct Curve {
  std::string label;  ///< written at its right end, unless it is the only one
  std::vector<PlotPoint> points;
  bool marked = false;  ///< a mark at every point
  bool dots = false;    ///< points alone, without a line
};

/// A line that is part of the scene: a rod, the outline of a body, the axis of a joint, or a mesh behind them. It may
/// also be a triangle that shows a slope, or the front of a cloud of points. Where a coordinate is not finite it is
/// interrupted.
struct Polyline {
  enum class Look { solid, bar, faint, dashed, front, axis, mesh };
  std::vector<PlotPoint> points;
  Look look = Look::solid;
  std::optional<std::size_t> colour = {};  ///< that of the curve of this number, else a grey
  bool dashed = false;                     ///< with the dashes of that curve: of two on each other both are seen
};

/// A part of a bar that stands on the axis of x, in the colour of the curve of this number.
struct Bar {
  double x, from, to;
  std::size_t colour = 0;
};
/// The width of a bar, as a share of a unit of x.
inline constexpr double bar_width = 0.7;

/// A place of the scene.
struct Mark {
  enum class Look { body, start, fixed, positive, negative, centre, joint };
  PlotPoint at;
  Look look = Look::body;
  std::string label;
  std::optional<std::size_t> colour = {};  ///< that of the curve of this number, else the one of its look
};

/// Words in a panel, to the right of a place.
struct Label {
  PlotPoint at;
  std::string text;
};

struct Panel {
  std::string title;
  Axis x, y;
  std::vector<Curve> curves;
  std::vector<Polyline> lines{};
  std::vector<Mark> marks{};
  std::vector<Label> labels{};
  std::vector<Bar> bars{};
  std::vector<PlotPoint> room_for{};  ///< points that the axes reach, drawn or not
  bool equal_axes = false;            ///< a unit of x is as long as one of y
  bool labels_beside = false;         ///< names of curves, with their marks, stand beside the panel wherever these end
  std::optional<double> round_off = {};  ///< on the axis of y: what is below is shaded, and the axis ends there
};

/// Panels of equal size, two in a row.
struct Figure {
  std::string name;      ///< of its file, without ending
  std::string caption;   ///< above
  std::string footnote;  ///< below: what made it
  std::vector<Panel> panels;
};

/// A text as it is: in the words of a figure _, ^ and braces lower, raise and join.
std::string plain(const std::string& text);

/// The gnuplot program that draws the figure, data included, into a file: SVG, PDF or PNG by its ending. Axes end where
/// the data end; curves differ in colour (which all eyes can tell apart), in their marks and dashes.
/// \throws InputError for another ending
std::string gnuplot_script(const Figure& figure, const std::string& file);

/// The program that draws figures of one size one after another, so many a second, into a GIF that repeats.
/// \throws InputError if the file does not end in .gif
std::string gnuplot_script(const std::vector<Figure>& frames, int a_second, const std::string& file);

}  // namespace hbvm
