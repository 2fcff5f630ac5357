#include "section/run_section.hpp"

#include "interruption.hpp"
#include "long_work/json.hpp"
#include "reference/compute_reference.hpp"
#include "run/scene_run.hpp"

namespace hbvm::core {
namespace {

std::string to_json(const SectionOrbit& orbit) {
  OrderedJson points = OrderedJson::array();
  for (const SectionPoint& point : orbit.points) points.push_back({point.t, point.x, point.y});
  return dumped(
      {{"H", orbit.H}, {"e_H", orbit.e_H}, {"points", points}, {"failure", orbit.failure}, {"grazes", orbit.grazes}},
      -1);
}

SectionOrbit orbit_of(const std::string& text) {
  return read_json(text, "an orbit of a section", [](const OrderedJson& json) {
    SectionOrbit orbit{{}, {}, json.at("H"), json.at("e_H"), {}, json.at("failure"), json.at("grazes")};
    for (const OrderedJson& point : json.at("points")) orbit.points.push_back({point.at(0), point.at(1), point.at(2)});
    return orbit;
  });
}

SectionOrbit orbit_of(const RunRequest& request) {
  SectionOrbit orbit;
  try {
    const Run run = core::run(request, {});
    for (const Observed& observed : run.observables)
      if (observed.name == "energy") orbit.H = observed.initial;
    orbit.e_H = run.e_H;
    for (const Event& event : run.events)
      if (event.grazes)
        ++orbit.grazes;
      else
        orbit.points.push_back({event.t, event.observed[0], event.observed[1]});
  } catch (const Interrupted&) {
    throw;
  } catch (const Error& error) {
    orbit.failure = error.what();
  }
  return orbit;
}

std::string key_of(const RunRequest& request, const SectionWork& work) {
  std::string key = "section|" + scene_hash(request.scene);
  for (const std::string& part :
       {work.plane, work.direction, work.x, work.y, request.method->text(), request.step.text(), request.until.text(),
        request.precision.name(), std::string(name_of(request.solver))})
    key += "|" + part;
  return key;
}

}  // namespace

RunRequest orbit_request(const SectionWork& work, std::size_t start) {
  RunRequest request = work.request;
  request.scene = work.starts[start].scene;
  return request;
}

std::optional<Section> run_section(const SectionWork& work, const CellOptions& options) {
  std::vector<WorkCell> cells;
  std::vector<std::vector<double>> near;  // here, so that a value that has none is told before anything is run
  for (const VariedScene& start : work.starts) near.push_back(start.near());
  for (std::size_t n = 0; n < work.starts.size(); ++n) {
    const RunRequest request = orbit_request(work, n);
    cells.push_back({key_of(request, work), [request] { return to_json(orbit_of(request)); }});
  }
  const std::vector<std::optional<std::string>> results = run_cells(cells, options);
  Section section{.scene = work.request.scene.name,
                  .method = work.request.method->text(),
                  .step = work.request.step.text(),
                  .until = work.request.until.text(),
                  .precision = work.request.precision.name(),
                  .plane = work.plane,
                  .direction = work.direction,
                  .title = work.request.scene.title.empty() ? work.request.scene.name : work.request.scene.title,
                  .names = {},
                  .x = work.x,
                  .y = work.y,
                  .orbits = {},
                  .command = work.command};
  for (const VariedNumber& number : work.numbers) section.names.push_back(number.name);
  bool any = false;
  for (std::size_t n = 0; n < results.size(); ++n) {
    if (!results[n]) return std::nullopt;
    SectionOrbit& orbit = section.orbits.emplace_back(orbit_of(*results[n]));
    for (const Expression& value : work.starts[n].values) orbit.start.push_back(value.text());
    orbit.start_near = near[n];
    any = any || orbit.failure.empty();
  }
  if (!any) throw InputError("no start has a motion: " + section.orbits.front().failure);
  return section;
}

}  // namespace hbvm::core
