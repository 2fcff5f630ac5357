#include "section/section_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "hbvm/version.hpp"

namespace hbvm::core {

std::string crossing_text(const Section& section) {
  return section.plane + " = 0" + (section.direction == "any" ? "" : ", " + section.direction + "wards");
}

Figure section_figure(const Section& section) {
  Panel panel;
  panel.x = {plain(section.x)};
  panel.y = {plain(section.y)};
  // Orbits whose colours are equal are one cloud.
  panel.curves.resize(std::min(section.orbits.size(), curve_colours.size()));
  std::size_t count = 0;
  for (std::size_t n = 0; n < section.orbits.size(); ++n) {
    Curve& curve = panel.curves[n % curve_colours.size()];
    curve.dots = true;
    for (const SectionPoint& point : section.orbits[n].points)
      curve.points.push_back({std::strtod(point.x.c_str(), nullptr), std::strtod(point.y.c_str(), nullptr)});
    count += section.orbits[n].points.size();
  }
  panel.title =
      plain(fmt::format("{} points of {} orbits where {}", count, section.orbits.size(), crossing_text(section)));
  Figure figure;
  figure.caption = plain(section.title);
  figure.footnote = std::string("hbvm ") + version() + ": " + section.command;
  figure.panels.push_back(std::move(panel));
  return figure;
}

}  // namespace hbvm::core
