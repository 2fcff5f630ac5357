#include "section/section_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "hbvm/version.hpp"
#include "long_work/json.hpp"
#include "report/html.hpp"
#include "run/recording.hpp"
#include "run/scene_run.hpp"
#include "scalar/literal.hpp"
#include "scene/coordinate_names.hpp"
#include "section/page_text.hpp"
#include "section/section_figure.hpp"

namespace hbvm::core {
namespace {

/// No more digits than are seen.
double seen(double x) { return std::strtod(fmt::format("{:.5g}", x).c_str(), nullptr); }
double seen(const std::string& x) { return seen(std::strtod(x.c_str(), nullptr)); }

/// The places of the x and y of each body among the coordinates.
std::vector<std::pair<std::size_t, std::size_t>> planes_of(const std::vector<std::string>& names) {
  std::vector<std::pair<std::size_t, std::size_t>> planes;
  for (std::size_t n = 0; n < names.size(); ++n) {
    if (!names[n].ends_with(".x")) continue;
    const auto y = std::find(names.begin(), names.end(), names[n].substr(0, names[n].size() - 1) + "y");
    if (y != names.end()) planes.emplace_back(n, static_cast<std::size_t>(y - names.begin()));
  }
  return planes;
}

/// Where each body goes at first: a list of x and y for each.
OrderedJson paths_of(RunRequest request) {
  constexpr const char* steps = "400";
  const std::string first = "(" + request.step.text() + ")*" + steps;
  const PrecisionScope scope(static_cast<unsigned>(request.precision.digits()));
  const Expression part = Expression::parse(first);
  if (evaluate<Mpfr>(part, request.scene.constants) < evaluate<Mpfr>(request.until, request.scene.constants))
    request.until = part;
  request.scene.events.clear();
  request.scene.observations.clear();
  Recording recording;
  RunHooks hooks;
  hooks.recording = &recording;
  run(request, hooks);
  OrderedJson paths = OrderedJson::array();
  for (const auto& [x, y] : planes_of(coordinate_names(request.scene))) {
    OrderedJson path = OrderedJson::array();
    for (const Recording::Sample& sample : recording.samples) path.push_back({seen(sample.q[x]), seen(sample.q[y])});
    paths.push_back(path);
  }
  return paths;
}

OrderedJson json_of(const Section& section, const SectionWork& work) {
  OrderedJson json{{"title", section.title}, {"x", section.x},           {"y", section.y},
                   {"names", section.names}, {"colours", curve_colours}, {"orbits", OrderedJson::array()}};
  for (std::size_t n = 0; n < section.orbits.size(); ++n) {
    const SectionOrbit& orbit = section.orbits[n];
    if (orbit.points.empty()) continue;
    OrderedJson points = OrderedJson::array(), start = OrderedJson::array();
    for (const SectionPoint& point : orbit.points) points.push_back({seen(point.x), seen(point.y)});
    for (const double value : orbit.start_near) start.push_back(fmt::format("{:.8g}", value));
    json["orbits"].push_back({{"number", n + 1},
                              {"start", start},
                              {"H", fmt::format("{:.10g}", std::strtod(orbit.H.c_str(), nullptr))},
                              {"e_H", fmt::format("{:.1e}", std::strtod(orbit.e_H.c_str(), nullptr))},
                              {"points", points},
                              {"paths", paths_of(orbit_request(work, n))}});
  }
  return json;
}

std::string with(std::string text, const std::string& place, const std::string& value) {
  const std::string mark = "@" + place + "@";
  const std::size_t at = text.find(mark);
  return at == std::string::npos ? text : text.replace(at, mark.size(), value);
}

}  // namespace

std::string section_page(const Section& section, const SectionWork& work) {
  const std::string about = fmt::format("Where {}. {}, steps of {} to t = {}, {}.", crossing_text(section),
                                        section.method, section.step, section.until, section.precision);
  std::string page = with(section_page_text(), "title", html(section.title));
  page = with(page, "heading", html(section.title));
  page = with(page, "about", html(about));
  page = with(page, "footer", html(std::string("hbvm ") + version() + ": " + section.command));
  return with(page, "data", within_script(dumped(json_of(section, work), -1)));
}

}  // namespace hbvm::core
