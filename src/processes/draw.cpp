#include "processes/draw.hpp"

#include <cstdio>
#include <cstdlib>

#include "hbvm/error.hpp"
#include "read_file.hpp"
#include "report/figure_layout.hpp"
#include "write_file.hpp"

namespace hbvm::core {
namespace {

/// Numbers of the curves within the drawing, which hbvm report reads.
std::string with_data(std::string svg, const std::string& data) {
  std::string text;
  for (const char c : data)
    text += c == '&' ? std::string("&amp;") : c == '<' ? std::string("&lt;") : std::string(1, c);
  const std::size_t end = svg.rfind("</svg>");
  if (end != std::string::npos) svg.insert(end, "<metadata id=\"hbvm-figure\">" + text + "</metadata>\n");
  return svg;
}

void run_gnuplot(const std::string& script, const std::string& file) {
  if (std::system("command -v gnuplot >/dev/null") != 0)
    throw Error("pictures need gnuplot, which is not installed: apt install gnuplot-nox");
  // Whatever the locale outside: in one without UTF-8 gnuplot warns that it cannot show a degree sign. Of a GIF it
  // says how many frames there are.
  std::FILE* const gnuplot =
      popen(file.ends_with(".gif") ? "LC_ALL=C.UTF-8 gnuplot 2>/dev/null" : "LC_ALL=C.UTF-8 gnuplot", "w");
  if (!gnuplot) throw Error("cannot start gnuplot");
  const bool written = std::fwrite(script.data(), 1, script.size(), gnuplot) == script.size();
  if (pclose(gnuplot) != 0 || !written) throw Error("gnuplot did not draw '" + file + "'");
}

}  // namespace

void draw(const Figure& figure, const std::string& file) {
  run_gnuplot(gnuplot_script(figure, file), file);
  if (file.ends_with(".svg")) write_file(file, with_data(read_file(file), figure_data(figure)));
}

void draw_frames(const std::vector<Figure>& frames, int a_second, const std::string& file) {
  run_gnuplot(gnuplot_script(frames, a_second, file), file);
}

}  // namespace hbvm::core
