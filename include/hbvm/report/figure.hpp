#pragma once

#include <optional>
#include <string>
#include <vector>

namespace hbvm {

/// A curve in a panel: columns of a CSV file, counted from 1.
struct Curve {
  std::string csv;
  int x = 1, y = 2;
  int z = 0;  ///< 0: a curve in the plane
  std::string label;
  bool spokes = false;  ///< thin lines from the origin to every fourth point, too
  bool points = false;  ///< mark the points
};

/// A line through given points: a rod, or a triangle of a slope.
struct Polyline {
  std::vector<std::vector<std::string>> points;
  std::string label;  ///< if it is empty, a thin line without points
};

/// A point marked in a panel.
struct Mark {
  std::vector<std::string> at;  ///< two or three coordinates
  std::string label;
};

/// Words in a panel.
struct Label {
  std::vector<std::string> at;  ///< two coordinates
  std::string text;
};

struct Panel {
  std::string title, x_label, y_label, z_label;
  std::vector<Curve> curves;
  std::vector<Mark> marks;
  std::vector<Polyline> lines;
  bool equal_axes = false;
  bool logarithms = false;  ///< x is a binary logarithm and y a decimal one: tics show the powers
  /// Both are decimal logarithms: tics show the powers, so many decades apart. 0: they are not.
  int x_decades = 0, y_decades = 0;
  std::vector<Label> labels{};
};

/// Panels side by side in one SVG.
struct Figure {
  std::string name, caption;
  std::vector<Panel> panels;
};

/// The gnuplot program that draws the figure into `svg`.
std::string gnuplot_script(const Figure& figure, const std::string& svg);

/// Runs it. \throws Error if gnuplot is missing or fails.
void draw(const Figure& figure, const std::string& svg);

}  // namespace hbvm
