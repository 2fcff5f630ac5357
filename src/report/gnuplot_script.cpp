#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "figure_layout.hpp"
#include "hbvm/error.hpp"
#include "hbvm/figure.hpp"
#include "label_places.hpp"

namespace hbvm::core {
namespace {

std::string colour_of(std::size_t curve) { return std::string(curve_colours[curve % curve_colours.size()]); }
constexpr int dashes[] = {1, 2, 4, 5, 3};
constexpr int marks[] = {7, 5, 9, 13, 11, 6, 4, 8, 12};

std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("''") : std::string(1, c);
  return result + "'";
}

/// The same where lines of the text are lines of the figure.
std::string in_lines(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '\n')
      result += "\\n";
    else
      result += c == '"' || c == '\\' ? std::string("\\") + c : std::string(1, c);
  }
  return result + "\"";
}

struct Placed {
  double at;  ///< in pixels from below
  std::size_t curve;
};

/// Moves labels apart that would stand on each other, as little as may be, and within the box.
void spread(std::vector<Placed>& labels) {
  std::sort(labels.begin(), labels.end(), [](const Placed& a, const Placed& b) { return a.at < b.at; });
  const double distance =
      std::min(line_height, box_height / static_cast<double>(std::max<std::size_t>(1, labels.size())));
  // Groups that touch are moved as one, to where their labels are off by least on average.
  struct Group {
    double wish;  // the sum of the places wanted for the lowest of it
    std::size_t first, size;
    double lowest(double apart) const {
      return std::clamp(wish / static_cast<double>(size), 0.0, box_height - apart * static_cast<double>(size - 1));
    }
  };
  std::vector<Group> groups;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    groups.push_back({labels[i].at, i, 1});
    while (groups.size() > 1) {
      const Group &upper = groups.back(), &lower = groups[groups.size() - 2];
      const double size = static_cast<double>(lower.size);
      if (lower.lowest(distance) + size * distance <= upper.lowest(distance)) break;
      const Group both{lower.wish + upper.wish - size * distance * static_cast<double>(upper.size), lower.first,
                       lower.size + upper.size};
      groups.pop_back();
      groups.back() = both;
    }
  }
  for (const Group& group : groups)
    for (std::size_t i = 0; i < group.size; ++i)
      labels[group.first + i].at = group.lowest(distance) + distance * static_cast<double>(i);
}

/// A panel as its place has it.
class PanelScript {
 public:
  PanelScript(const Panel& panel, const PanelPlace& place)
      : panel_(panel), left_(place.left), bottom_(place.bottom), x_(place.x), y_(place.y) {}

  /// \param size of the figure
  /// \param words labels of the figure that are drawn with this panel
  std::string text(const PlotPoint& size, const std::string& words) {
    const double x = left_, y = bottom_;
    script_ = fmt::format("set lmargin at screen {:.5f}\nset rmargin at screen {:.5f}\n", x / size[0],
                          (x + box_width) / size[0]) +
              fmt::format("set bmargin at screen {:.5f}\nset tmargin at screen {:.5f}\n", y / size[1],
                          (y + box_height) / size[1]) +
              "unset label\n" + words + "set title " + quoted(panel_.title) + " offset 0,-0.4\n";
    axis("x", panel_.x, x_, 6);
    axis("y", panel_.y, y_, 6);
    shade();
    for (const Polyline& line : panel_.lines) add(line);
    for (const Bar& bar : panel_.bars) add(bar);
    for (std::size_t i = 0; i < panel_.curves.size(); ++i) add(panel_.curves[i], i);
    for (const Mark& mark : panel_.marks) add(mark);
    label_marks();
    for (const Label& label : panel_.labels) write(label.at, label.text, "black", 0);
    if (has_names(panel_)) label_curves();
    if (parts_.empty()) parts_.emplace_back("NaN notitle");
    std::string plot = "plot ";
    for (std::size_t i = 0; i < parts_.size(); ++i) plot += (i > 0 ? ", \\\n     " : "") + parts_[i];
    return script_ + plot + "\n";
  }

 private:
  void axis(const std::string& name, const Axis& axis, const AxisRange& range, int most) {
    Tics tics = tics_of(range, axis.scale, most);
    if (!axis.names.empty()) tics = {};
    for (std::size_t i = 0; i < axis.names.size(); ++i) tics.tics.push_back({static_cast<double>(i), axis.names[i]});
    const std::string label = axis.label + (tics.factor.empty() ? "" : " / " + tics.factor);
    script_ += fmt::format("set {0}range [{1:.12g}:{2:.12g}]\nset {0}label {3}{4}\nset {0}tics (", name, range.from,
                           range.to, quoted(label),
                           name != "x"          ? ""
                           : axis.names.empty() ? " offset 0,0.2"
                                                : " offset 0,-1.3");
    std::string list;
    for (const Tic& tic : tics.tics)
      list +=
          fmt::format("{}{} {:.12g}{}", list.empty() ? "" : ", ",
                      axis.names.empty() ? quoted(tic.text) : in_lines(tic.text), tic.at, tic.text.empty() ? " 1" : "");
    script_ += list + ")\n";
  }

  /// What is below round-off.
  void shade() {
    script_ += "unset object\n";
    if (!panel_.round_off) return;
    script_ += fmt::format(
        "set object 1 rectangle from graph 0, graph 0 to graph 1, first {:.9g} fc rgb '#ececec' fs solid noborder "
        "behind\nset label 'round-off' at graph 0.99, first {:.9g} right offset 0,0.5 tc rgb '#777777'\n",
        *panel_.round_off, y_.from);
  }

  std::string data(const std::vector<PlotPoint>& points) {
    const std::string name = fmt::format("$data{}", ++blocks_);
    script_ += name + " << EOD\n";
    bool open = false;
    for (const PlotPoint& point : points) {
      const bool drawn = std::isfinite(point[0]) && std::isfinite(point[1]);
      // As many digits as the range has, or the marker of its last point may lie beyond it.
      if (drawn) script_ += fmt::format("{:.12g} {:.12g}\n", point[0], point[1]);
      if (!drawn && open) script_ += "\n";
      open = drawn;
    }
    script_ += "EOD\n";
    return name + " using 1:2 ";
  }

  static bool any(const std::vector<PlotPoint>& points) {
    return std::any_of(points.begin(), points.end(),
                       [](const PlotPoint& p) { return std::isfinite(p[0]) && std::isfinite(p[1]); });
  }

  void add(const Curve& curve, std::size_t i) {
    if (!any(curve.points)) return;
    const std::string colour = quoted(colour_of(i));
    const int dash = dashes[i % std::size(dashes)], mark = marks[i % std::size(marks)];
    constexpr std::size_t few = 40;
    const bool differ = panel_.curves.size() > 1 && !panel_.equal_axes;
    std::string style;
    if (curve.dots)
      style = "with points pt 7 ps 0.12";
    else if (curve.marked)
      style = fmt::format("with linespoints lw 1.4 dt {} pt {} ps 0.5", dash, mark);
    else if (differ && curve.points.size() > few)
      style = fmt::format("with linespoints lw 1.2 pt {} ps 0.6 pi {}", mark, 1 + curve.points.size() / 8 + i);
    else
      style = fmt::format("with lines lw {} dt {}", panel_.equal_axes ? "0.9" : "1.3", differ ? dash : 1);
    parts_.push_back(data(curve.points) + style + " lc rgb " + colour + " notitle");
  }

  void add(const Polyline& line) {
    if (!any(line.points)) return;
    using Look = Polyline::Look;
    const auto [style, grey] = line.look == Look::solid   ? std::pair("lw 1.6", "#333333")
                               : line.look == Look::bar   ? std::pair("lw 3", "#333333")
                               : line.look == Look::faint ? std::pair("lw 0.8", "#999999")
                               : line.look == Look::front ? std::pair("lw 6", "#d9d9d9")
                               : line.look == Look::axis  ? std::pair("lw 1.2 dt 4", "#333333")
                               : line.look == Look::mesh  ? std::pair("lw 0.4", "#c4c4c4")
                                                          : std::pair("lw 1 dt 2", "#777777");
    const std::string dash = line.dashed && line.colour && line.look != Look::axis
                                 ? fmt::format(" dt {}", dashes[*line.colour % std::size(dashes)])
                                 : "";
    parts_.push_back(data(line.points) + "with lines " + style + dash + " lc rgb " +
                     quoted(line.colour ? colour_of(*line.colour) : grey) + " notitle");
  }

  void add(const Bar& bar) {
    const std::string name = fmt::format("$data{}", ++blocks_);
    script_ += fmt::format("{} << EOD\n{:.7g} {:.7g} {:.7g} {:.7g}\nEOD\n", name, bar.x - bar_width / 2,
                           bar.x + bar_width / 2, bar.from, bar.to);
    parts_.push_back(
        fmt::format("{} using (($1+$2)/2):(($3+$4)/2):1:2:3:4 with boxxyerror fs solid 1 noborder lc rgb {} "
                    "notitle",
                    name, quoted(colour_of(bar.colour))));
  }

  void add(const Mark& mark) {
    if (!any({mark.at})) return;
    using Look = Mark::Look;
    const auto [style, usual] = mark.look == Look::body       ? std::pair("pt 7 ps 0.9", "black")
                                : mark.look == Look::start    ? std::pair("pt 6 ps 0.8", "#666666")
                                : mark.look == Look::fixed    ? std::pair("pt 9 ps 1.3", "black")
                                : mark.look == Look::centre   ? std::pair("pt 7 ps 0.45", "black")
                                : mark.look == Look::joint    ? std::pair("pt 6 ps 0.6 lw 1.5", "black")
                                : mark.look == Look::positive ? std::pair("pt 1 ps 1.4 lw 1.5", "#D55E00")
                                                              : std::pair("pt 2 ps 1.2 lw 1.5", "#0072B2");
    const std::string at = data({mark.at});
    if (mark.look == Mark::Look::joint) parts_.push_back(at + "with points pt 7 ps 0.6 lc rgb 'white' notitle");
    parts_.push_back(at + "with points " + style + " lc rgb " + quoted(mark.colour ? colour_of(*mark.colour) : usual) +
                     " notitle");
  }

  void write(const PlotPoint& at, const std::string& text, const std::string& colour, double lines_up,
             double letters_right = 0.7) {
    script_ += fmt::format("set label {} at {:.9g},{:.9g} left offset {},{} tc rgb {} front\n", quoted(text), at[0],
                           at[1], letters_right, lines_up, quoted(colour));
  }

  /// Marks that hide each other have their names in one line, at a side where nothing else is.
  void label_marks() {
    constexpr double hidden = 8;  // pixels
    std::vector<LabelledMark> named;
    std::vector<std::string> texts;
    for (const Mark& mark : panel_.marks) {
      if (!any({mark.at})) continue;
      const PlotPoint at{(mark.at[0] - x_.from) / x_.length() * box_width,
                         (mark.at[1] - y_.from) / y_.length() * box_height};
      const auto near = std::find_if(named.begin(), named.end(), [&](const LabelledMark& other) {
        return std::abs(other.at[0] - at[0]) < hidden && std::abs(other.at[1] - at[1]) < hidden;
      });
      const auto n = static_cast<std::size_t>(near - named.begin());
      if (near == named.end()) {
        named.push_back({at, 0, line_height});
        texts.emplace_back();
      }
      if (!mark.label.empty()) texts[n] += (texts[n].empty() ? "" : ", ") + mark.label;
      named[n].width = letter_width * static_cast<double>(letters(texts[n]));
    }
    const std::vector<std::optional<Rectangle>> places = label_places(named, {0, 0, box_width, box_height});
    for (std::size_t n = 0; n < named.size(); ++n) {
      if (!places[n]) continue;
      const Rectangle& place = *places[n];
      const double at = named[n].at[0];
      const bool right = place.left > at, left = place.left + place.width < at;
      const double x = right ? place.left : left ? place.left + place.width : at;
      script_ += fmt::format("set label {} at graph {:.5f},{:.5f} {} tc rgb 'black' front\n", quoted(plain(texts[n])),
                             x / box_width, (place.bottom + place.height / 2) / box_height,
                             right  ? "left"
                             : left ? "right"
                                    : "center");
    }
  }

  /// Where each curve ends: at the right of the box, moved apart, or below a point within it.
  void label_curves() {
    std::vector<Placed> labels;
    std::vector<std::size_t> within;
    for (std::size_t i = 0; i < panel_.curves.size(); ++i) {
      const Curve& curve = panel_.curves[i];
      if (curve.label.empty() || !any(curve.points)) continue;
      const PlotPoint last = end_of(curve);
      if (!panel_.labels_beside && last[0] < x_.to - 0.1 * x_.length()) {
        within.push_back(i);
        continue;
      }
      labels.push_back({box_height * std::clamp((last[1] - y_.from) / y_.length(), 0.0, 1.0), i});
    }
    label_within(within);
    spread(labels);
    for (const Placed& label : labels) {
      const Curve& curve = panel_.curves[label.curve];
      const std::string colour = quoted(colour_of(label.curve));
      script_ += fmt::format("set label {} at graph {},{:.5f} left tc rgb {}", quoted(curve.label),
                             panel_.labels_beside ? "1.03" : "1.02", label.at / box_height, colour);
      if (panel_.labels_beside && curve.marked)
        script_ += fmt::format(" point pt {} ps 0.6 lc rgb {} offset 0.8,-0.35", marks[label.curve % std::size(marks)],
                               colour);
      script_ += "\n";
    }
  }

  static PlotPoint end_of(const Curve& curve) {
    return *std::find_if(curve.points.rbegin(), curve.points.rend(),
                         [](const PlotPoint& p) { return std::isfinite(p[0]) && std::isfinite(p[1]); });
  }

  /// Below the ends of curves; of those that end at the same place, one after another.
  void label_within(const std::vector<std::size_t>& curves) {
    for (std::size_t n = 0; n < curves.size(); ++n) {
      const Curve& curve = panel_.curves[curves[n]];
      const PlotPoint at = end_of(curve);
      const bool lowest = at[1] < y_.from + 0.1 * y_.length();
      double letters_right = lowest ? 2.5 : 0.7;
      for (std::size_t before = 0; before < n; ++before) {
        const Curve& other = panel_.curves[curves[before]];
        const PlotPoint there = end_of(other);
        if (std::abs(there[1] - at[1]) * box_height < line_height * y_.length() &&
            std::abs(there[0] - at[0]) * box_width < letter_width * x_.length())
          letters_right += static_cast<double>(letters(other.label)) + 1;
      }
      write(at, curve.label, colour_of(curves[n]), lowest ? 0 : -0.6, letters_right);
    }
  }

  const Panel& panel_;
  double left_, bottom_;
  AxisRange x_, y_;
  std::string script_;
  std::vector<std::string> parts_;
  int blocks_ = 0;
};

/// A terminal of gnuplot, and how large its letters are: 1 where a pixel is a pixel.
struct Terminal {
  std::string text;
  double letters;
};

constexpr double points_a_pixel = 0.75;

Terminal terminal_of(const std::string& file, const PlotPoint& size) {
  constexpr double pixels_an_inch = 96;
  if (file.ends_with(".svg"))
    return {fmt::format("svg size {:.0f},{:.0f} enhanced background rgb 'white'", size[0], size[1]), 1};
  if (file.ends_with(".pdf"))
    return {fmt::format("pdfcairo size {:.3f}in,{:.3f}in enhanced background rgb 'white'", size[0] / pixels_an_inch,
                        size[1] / pixels_an_inch),
            points_a_pixel};
  // Twice the pixels, for paper and for fine screens.
  if (file.ends_with(".png"))
    return {fmt::format("pngcairo size {:.0f},{:.0f} fontscale 2 linewidth 2 pointscale 2 enhanced background rgb "
                        "'white'",
                        2 * size[0], 2 * size[1]),
            points_a_pixel};
  throw InputError("a picture is .svg, .pdf or .png, not '" + file + "'");
}

std::string font_of(double pixels, const Terminal& terminal) {
  return fmt::format("font 'sans,{:g}'", pixels * terminal.letters);
}

/// What stands before all pictures of a file.
std::string opening(const Terminal& terminal, const std::string& file) {
  return "set encoding utf8\nset minussign\nset terminal " + terminal.text + " " + font_of(12, terminal) +
         "\nset output " + quoted(file) + "\nset grid lc rgb '#e4e4e4' lw 0.7\nset tics " + font_of(10, terminal) +
         " scale 0.6\nunset key\nset border lc rgb '#555555'\n";
}

std::string picture(const Figure& figure, const Terminal& terminal) {
  const FigureLayout layout = layout_of(figure);
  const PlotPoint& size = layout.size;
  const auto font = [&](double pixels) { return font_of(pixels, terminal); };
  std::string text = "set multiplot\n", words;
  if (!figure.caption.empty())
    words += fmt::format("set label 1 {} at screen 0.5,{:.5f} center {}\n", quoted(figure.caption),
                         1 - 0.55 * title_height / size[1], font(14));
  for (std::size_t n = 0; n < layout.footnote.size(); ++n) {
    const double below = 0.5 * footnote_height + line_height * static_cast<double>(layout.footnote.size() - 1 - n);
    words += fmt::format("set label {} {} at screen {:.5f},{:.5f} left {} tc rgb '#555555'\n", 2 + n,
                         in_lines(plain(layout.footnote[n])), 12 / size[0], below / size[1], font(9));
  }
  for (std::size_t i = 0; i < figure.panels.size(); ++i)
    text += PanelScript(figure.panels[i], layout.panels[i]).text(size, i == 0 ? words : "");
  return text + "unset multiplot\n";
}

}  // namespace

}  // namespace hbvm::core

namespace hbvm {

std::string plain(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (std::string_view("^_@&~{}\\").find(c) != std::string_view::npos) result += '\\';
    result += c;
  }
  return result;
}

std::string gnuplot_script(const Figure& figure, const std::string& file) {
  const core::Terminal terminal = core::terminal_of(file, core::layout_of(figure).size);
  return core::opening(terminal, file) + core::picture(figure, terminal);
}

std::string gnuplot_script(const std::vector<Figure>& frames, int a_second, const std::string& file) {
  if (!file.ends_with(".gif")) throw InputError("a picture that moves is .gif, not '" + file + "'");
  const PlotPoint size = core::layout_of(frames.empty() ? Figure{} : frames.front()).size;
  constexpr int hundredths = 100;
  const core::Terminal terminal{fmt::format("gif animate delay {} loop 0 size {:.0f},{:.0f} enhanced background "
                                            "rgb 'white'",
                                            hundredths / a_second, size[0], size[1]),
                                core::points_a_pixel};
  std::string text = core::opening(terminal, file);
  for (const Figure& frame : frames) text += core::picture(frame, terminal);
  return text;
}

}  // namespace hbvm
