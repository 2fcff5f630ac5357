#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "csv_line.hpp"
#include "door/door.hpp"
#include "door/run_of.hpp"
#include "door/section_of.hpp"
#include "long_work/json.hpp"
#include "scene/add_event.hpp"
#include "scene/set_number.hpp"
#include "section/section_figure.hpp"
#include "section/section_page.hpp"

namespace hbvm {
namespace core {
namespace {

std::string command_of(const SectionRequest& asked, const SectionWork& work) {
  const auto quoted = [](const std::string& text) { return " '" + text + "'"; };
  const RunRequest& run = work.request;
  std::string text = "hbvm section " + run.scene.name + settings_in_command(core::scene_of(asked.scene)) + " --plane" +
                     quoted(asked.plane);
  if (asked.direction != "up") text += " --direction " + asked.direction;
  text += " --axes" + quoted(asked.axes.first) + quoted(asked.axes.second);
  for (const std::string& starts : asked.starts) text += " --starts" + quoted(starts);
  return text + " --method " + run.method->text() + " --step" + quoted(run.step.text()) + " --until" +
         quoted(run.until.text()) + " --precision " + run.precision.name();
}

}  // namespace

SectionWork section_work(const SectionRequest& asked) {
  hbvm::RunRequest run{.scene = asked.scene, .method = asked.method, .step = asked.step, .until = asked.until};
  run.precision = asked.precision;
  run.solver = asked.solver;
  SectionWork work{request_of(run, {}), asked.plane, asked.direction, asked.axes.first, asked.axes.second, {}, {}, {}};
  Scene& scene = work.request.scene;
  scene.events.clear();
  scene.observations.clear();
  scene.observables = {"energy"};
  add_event(scene, "plane", asked.plane, asked.direction);
  for (const auto& [name, formula] : {std::pair("x", asked.axes.first), {"y", asked.axes.second}}) try {
      scene.observations.push_back({name, Expression::parse(formula, Expression::Syntax::observation), 0});
    } catch (const ExpressionError& error) {
      throw InputError("the axis '" + formula + "': " + error.what());
    }
  for (const std::string& text : asked.starts) work.numbers.push_back(parse_starts(text));
  work.starts = starts_of(scene, work.numbers);
  work.command = command_of(asked, work);
  return work;
}

}  // namespace core

Section section(const SectionRequest& request) {
  const core::Admitted admitted(request.stop);
  core::CellOptions options;
  options.jobs = request.jobs;
  options.progress = request.progress;
  return *core::run_section(core::section_work(request), options);
}

Figure figure_of(const Section& section) { return core::section_figure(section); }

std::string page_of(const Section& section, const SectionRequest& request) {
  const core::Admitted admitted(request.stop);
  return core::section_page(section, core::section_work(request));
}

std::string to_text(const Section& section) {
  std::string text = fmt::format("{}: {}, steps of {} to t = {}, {}\nwhere {} = 0, {}; points are ({}, {})\n\n",
                                 section.scene, section.method, section.step, section.until, section.precision,
                                 section.plane, section.direction, section.x, section.y);
  double least = HUGE_VAL, greatest = -HUGE_VAL;
  std::size_t count = 0;
  for (std::size_t n = 0; n < section.orbits.size(); ++n) {
    const SectionOrbit& orbit = section.orbits[n];
    std::string start;
    for (std::size_t i = 0; i < section.names.size(); ++i)
      start += fmt::format("{}{} = {:.8g}", i == 0 ? "" : ", ", section.names[i], orbit.start_near[i]);
    text += fmt::format("orbit {}{}", n + 1, start.empty() ? "" : ", " + start);
    if (!orbit.failure.empty()) {
      text += ": " + orbit.failure + "\n";
      continue;
    }
    const double H = std::strtod(orbit.H.c_str(), nullptr);
    least = std::min(least, H);
    greatest = std::max(greatest, H);
    count += orbit.points.size();
    text += fmt::format(": {} points{}, H = {:.10g}, off by {:.1e}\n", orbit.points.size(),
                        orbit.grazes == 0 ? "" : fmt::format(" ({} times it only touched)", orbit.grazes), H,
                        std::strtod(orbit.e_H.c_str(), nullptr));
  }
  text += fmt::format("\n{} points\n", count);
  constexpr double equal = 1'000'000;
  if (greatest - least > std::max(std::abs(greatest), std::abs(least)) / equal)
    text += fmt::format("the orbits differ in H, from {:.6g} to {:.6g}: a section is of one H\n", least, greatest);
  return text;
}

std::string to_json(const Section& section) {
  core::OrderedJson j{
      {"scene", section.scene},         {"method", section.method},       {"step", section.step},
      {"until", section.until},         {"precision", section.precision}, {"plane", section.plane},
      {"direction", section.direction}, {"axes", {section.x, section.y}}, {"orbits", core::OrderedJson::array()}};
  for (const SectionOrbit& orbit : section.orbits) {
    core::OrderedJson start = core::OrderedJson::object(), points = core::OrderedJson::array();
    for (std::size_t i = 0; i < section.names.size(); ++i) start[section.names[i]] = orbit.start[i];
    for (const SectionPoint& point : orbit.points) points.push_back({{"t", point.t}, {"x", point.x}, {"y", point.y}});
    core::OrderedJson one{{"start", start}, {"H", orbit.H}, {"e_H", orbit.e_H}, {"points", points}};
    if (!orbit.failure.empty()) one = {{"start", start}, {"failure", orbit.failure}};
    if (orbit.grazes > 0) one["grazes"] = orbit.grazes;
    j["orbits"].push_back(one);
  }
  j["command"] = section.command;
  return core::dumped(j, 2);
}

std::string to_csv(const Section& section) {
  std::vector<std::string> columns{"orbit"};
  columns.insert(columns.end(), section.names.begin(), section.names.end());
  for (const std::string& name : {std::string("t"), section.x, section.y}) columns.push_back(name);
  std::string text = core::csv_line(columns) + "\n";
  for (std::size_t n = 0; n < section.orbits.size(); ++n)
    for (const SectionPoint& point : section.orbits[n].points) {
      std::vector<std::string> cells{std::to_string(n + 1)};
      cells.insert(cells.end(), section.orbits[n].start.begin(), section.orbits[n].start.end());
      for (const std::string& value : {point.t, point.x, point.y}) cells.push_back(value);
      text += core::csv_line(cells) + "\n";
    }
  return text;
}

}  // namespace hbvm
