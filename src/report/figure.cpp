#include "hbvm/report/figure.hpp"

#include <cstdio>

#include "hbvm/error.hpp"

namespace hbvm {
namespace {

std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("''") : std::string(1, c);
  return result + "'";
}

std::string columns(const std::string& before, const std::vector<int>& list) {
  std::string text = before;
  for (const int column : list)
    if (column > 0) text += (text.empty() ? "" : ":") + std::to_string(column);
  return text;
}

/// The points of a mark or line as an inline data block, a line each.
std::string data_block(const std::string& name, const std::vector<std::vector<std::string>>& points) {
  std::string text = name + " << EOD\n";
  for (const auto& point : points) {
    for (std::size_t i = 0; i < point.size(); ++i) text += (i > 0 ? "," : "") + point[i];
    text += "\n";
  }
  return text + "EOD\n";
}

std::string plot_of(const Panel& panel) {
  const auto three_entries = [](const std::vector<std::string>& at) { return at.size() == 3; };
  const bool space = (!panel.curves.empty() && panel.curves.front().z > 0) ||
                     (!panel.lines.empty() && three_entries(panel.lines.front().points.front()));
  std::string setup = "set title " + quoted(panel.title) + "\nset xlabel " + quoted(panel.x_label) + "\nset ylabel " +
                      quoted(panel.y_label) + "\n";
  if (space)
    setup += "set zlabel " + quoted(panel.z_label) + " rotate parallel\nset view 65,35\nset xyplane relative 0.05\n";
  if (panel.x_decades > 0)
    setup += "set format '10^{%g}'\nset xtics " + std::to_string(panel.x_decades) + "\nset ytics " +
             std::to_string(panel.y_decades) + "\n";
  else
    setup += panel.logarithms ? "set format x '2^{%g}'\nset format y '10^{%g}'\n" : "set format '% h'\n";
  setup += "unset label\n";
  for (const Label& label : panel.labels)
    setup += "set label " + quoted(label.text) + " at " + label.at.at(0) + "," + label.at.at(1) + "\n";
  setup += panel.equal_axes && !space ? "set size ratio -1\n" : "set size noratio\n";
  std::vector<std::string> parts;
  for (const Curve& curve : panel.curves) {
    if (curve.spokes)
      parts.push_back(quoted(curve.csv) + " every 4 using " +
                      columns(space ? "(0):(0):(0)" : "(0):(0)", {curve.x, curve.y, curve.z}) +
                      " with vectors nohead lw 0.5 lc rgb '#aaaaaa' notitle");
    parts.push_back(quoted(curve.csv) + " using " + columns("", {curve.x, curve.y, curve.z}) +
                    (curve.points ? " with linespoints pt 7 ps 0.5 lw 1.2 title " : " with lines lw 1.2 title ") +
                    quoted(curve.label));
  }
  std::string data;
  const auto inline_part = [&](const std::vector<std::vector<std::string>>& points, const std::string& style) {
    const std::string name = "$data" + std::to_string(parts.size());
    data += data_block(name, points);
    parts.push_back(name + " using 1:2" + (space ? ":3 " : " ") + style);
  };
  for (const Polyline& line : panel.lines)
    inline_part(line.points, line.label.empty() ? std::string("with lines lw 1 lc rgb 'black' notitle")
                                                : "with linespoints pt 7 ps 0.8 lw 2 title " + quoted(line.label));
  for (const Mark& mark : panel.marks)
    inline_part({mark.at}, "with points pt 3 ps 1.2 lc rgb 'black' title " + quoted(mark.label));
  std::string plot = space ? "splot " : "plot ";
  for (std::size_t i = 0; i < parts.size(); ++i) plot += (i > 0 ? ", " : "") + parts[i];
  return setup + data + plot + "\n";
}

}  // namespace

std::string gnuplot_script(const Figure& figure, const std::string& svg) {
  const std::size_t count = figure.panels.size();
  std::string text = "set datafile separator ','\nset datafile commentschars '#'\nset minussign\nset encoding utf8\n";
  // One panel needs room for the names below it.
  text += "set terminal svg size " + std::to_string(count == 1 ? 600 : 480 * count) +
          ",420 enhanced background rgb 'white' font 'sans,13'\n";
  text += "set output " + quoted(svg) +
          "\nset grid lc rgb '#dddddd'\nset tics font ',10'\nset offsets graph 0.02,0.02,0.02,0.02\nset key bottom "
          "center outside horizontal\n";
  text += "set multiplot layout 1," + std::to_string(count) + "\n";
  for (const Panel& panel : figure.panels) text += plot_of(panel);
  return text + "unset multiplot\n";
}

void draw(const Figure& figure, const std::string& svg) {
  // Whatever the locale outside: in one without UTF-8 gnuplot warns that it cannot show a degree sign.
  std::FILE* const gnuplot = popen("LC_ALL=C.UTF-8 gnuplot", "w");
  if (!gnuplot) throw Error("cannot start gnuplot");
  const std::string script = gnuplot_script(figure, svg);
  const bool written = std::fwrite(script.data(), 1, script.size(), gnuplot) == script.size();
  if (pclose(gnuplot) != 0 || !written) throw Error("gnuplot did not draw " + svg + "; is gnuplot-nox installed?");
}

}  // namespace hbvm
