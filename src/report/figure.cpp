#include "hbvm/report/figure.hpp"

#include <cstdio>
#include <cstdlib>

#include "hbvm/error.hpp"

namespace hbvm {

void draw(const Figure& figure, const std::string& file) {
  const std::string script = gnuplot_script(figure, file);
  if (std::system("command -v gnuplot >/dev/null") != 0)
    throw Error("pictures need gnuplot, which is not installed: apt install gnuplot-nox");
  // Whatever the locale outside: in one without UTF-8 gnuplot warns that it cannot show a degree sign.
  std::FILE* const gnuplot = popen("LC_ALL=C.UTF-8 gnuplot", "w");
  if (!gnuplot) throw Error("cannot start gnuplot");
  const bool written = std::fwrite(script.data(), 1, script.size(), gnuplot) == script.size();
  if (pclose(gnuplot) != 0 || !written) throw Error("gnuplot did not draw '" + file + "'");
}

}  // namespace hbvm
