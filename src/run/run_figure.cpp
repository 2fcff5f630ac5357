#include "run/run_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>

#include "run/horizon.hpp"
#include "run/multiplier_names.hpp"
#include "run/smooth_path.hpp"

namespace hbvm::core {
namespace {

constexpr const char* axes = "xyz";

PlotPoint project(const std::array<double, 3>& x, const Projection& projection) {
  return {x[static_cast<std::size_t>(projection.across)], x[static_cast<std::size_t>(projection.up)]};
}

/// What is seen of a body's edges, with gaps between them.
Polyline outline_of(const Sketch& sketch, const Sketch::Body& body, const std::vector<double>& q,
                    const Projection& projection) {
  const Solid& solid = body.solid;
  std::vector<PlotPoint> corners;
  for (const std::array<double, 3>& corner : sketch.corners(body, q)) corners.push_back(project(corner, projection));
  std::vector<bool> towards;
  for (const std::vector<std::size_t>& face : solid.faces) {
    double area = 0;
    for (std::size_t i = 0; i < face.size(); ++i) {
      const PlotPoint &a = corners[face[i]], &b = corners[face[(i + 1) % face.size()]];
      area += a[0] * b[1] - a[1] * b[0];
    }
    towards.push_back(area > 0);
  }
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  Polyline outline;
  for (const Solid::Edge& edge : solid.edges)
    if (solid.shows(edge, towards))
      outline.points.insert(outline.points.end(), {corners[edge.ends[0]], corners[edge.ends[1]], {nothing, nothing}});
  return outline;
}

/// The colour of what moves with each place: that of the path of its body.
std::map<std::size_t, std::size_t> colours_of_paths(const Sketch& sketch) {
  std::map<std::size_t, std::size_t> colours;
  for (std::size_t i = 0; i < sketch.places.size(); ++i)
    if (sketch.places[i].has_mass) colours.emplace(i, colours.size());
  return colours;
}

/// The lines of the scene at one state, and the outlines of its rigid bodies.
/// \param one colour of all; without it each is drawn in that of its body's path
void add_links(Panel& panel, const Sketch& sketch, const std::vector<double>& q, const Projection& projection,
               Polyline::Look look, std::optional<std::size_t> one = {}) {
  const bool whole = look == Polyline::Look::solid;
  const std::map<std::size_t, std::size_t> colours = colours_of_paths(sketch);
  for (const Sketch::Link& link : sketch.links) {
    if (link.as == Sketch::Joins::axis && !whole) continue;
    const Polyline::Look drawn = !whole                             ? look
                                 : link.as == Sketch::Joins::spring ? Polyline::Look::faint
                                 : link.as == Sketch::Joins::axis   ? Polyline::Look::axis
                                 : link.as == Sketch::Joins::body   ? Polyline::Look::bar
                                                                    : look;
    Polyline& line = panel.lines.emplace_back(Polyline{
        {project(sketch.position(link.a, q), projection), project(sketch.position(link.b, q), projection)}, drawn});
    line.colour = one;
    if (!one && whole && link.as == Sketch::Joins::body) line.colour = colours.at(*sketch.places[link.a].of);
  }
  for (const Sketch::Body& body : sketch.bodies) {
    Polyline& outline = panel.lines.emplace_back(outline_of(sketch, body, q, projection));
    outline.look = whole ? look : Polyline::Look::faint;
    if (whole) outline.colour = one.value_or(colours.at(body.place));
  }
}

/// What stands at a place: a body, a fixed point, a joint, a charge.
void add_marks(Panel& panel, const Sketch::Place& place, const PlotPoint& at, const std::string& label,
               std::optional<std::size_t> colour) {
  if (place.has_mass)
    panel.marks.push_back({at, place.of ? Mark::Look::centre : Mark::Look::body, label, colour});
  else if (place.mark == Sketch::Place::Mark::dot && place.at.blocks.empty())
    panel.marks.push_back({at, Mark::Look::fixed, label, colour});
  else if (place.mark == Sketch::Place::Mark::joint)
    panel.marks.push_back({at, Mark::Look::joint, "", colour});
  if (place.charge != 0)
    panel.marks.push_back({at, place.charge > 0 ? Mark::Look::positive : Mark::Look::negative, "", colour});
}

bool moves(const Sketch::Place& place) { return place.has_mass || !place.at.blocks.empty(); }

/// Lines behind all else, with gaps between them.
void add_lines(Panel& panel, const std::vector<PointLine>& lines, const Projection& projection, Polyline::Look look) {
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  Polyline all{{}, look};
  for (const PointLine& line : lines) {
    for (const std::array<double, 3>& point : line) all.points.push_back(project(point, projection));
    all.points.push_back({nothing, nothing});
  }
  if (!all.points.empty()) panel.lines.push_back(std::move(all));
}

/// The path of a place.
Curve path_of(const Sketch& sketch, std::size_t place, const Recording& recording, const Projection& projection) {
  constexpr std::size_t at_least = 2'000;
  std::vector<PathPoint> points;
  for (const Recording::Sample& sample : recording.samples) {
    PathPoint& point =
        points.emplace_back(PathPoint{sample.t, project(sketch.position(place, sample.q), projection), {}});
    if (!sample.v.empty()) point.velocity = project(sketch.velocity(place, sample.v), projection);
  }
  const bool has_velocities = !recording.samples.front().v.empty();
  return {"", smooth_path(points, has_velocities ? at_least : 0)};
}

Panel against_time(const std::string& title, const Axis& y) {
  Panel panel;
  panel.title = title;
  panel.x.label = "t";
  panel.y = y;
  return panel;
}

/// One value of each sample.
Curve curve_of(const std::string& label, const Recording& recording,
               const std::function<double(const Recording::Sample&)>& value) {
  Curve curve{label, {}};
  for (const Recording::Sample& sample : recording.samples) curve.points.push_back({sample.t, value(sample)});
  return curve;
}

/// A sample stands for all mesh points since the one before. What they reach beyond the two samples is a stroke half
/// way between.
Curve range_of(const std::string& label, const Recording& recording, std::size_t i,
               std::vector<double> Recording::Sample::*value, std::vector<double> Recording::Sample::*least,
               std::vector<double> Recording::Sample::*greatest) {
  Curve curve{label, {}};
  for (const Recording::Sample& sample : recording.samples) {
    const double now = (sample.*value)[i];
    if (recording.every > 1 && !curve.points.empty()) {
      const PlotPoint before = curve.points.back();
      const double middle = before[0] + (sample.t - before[0]) / 2;
      for (const double reached : {(sample.*least)[i], (sample.*greatest)[i]})
        if (reached < std::min(before[1], now) || reached > std::max(before[1], now))
          curve.points.push_back({middle, reached});
    }
    curve.points.push_back({sample.t, now});
  }
  return curve;
}

/// A name, or a number if it is too long to stand beside a panel.
std::string beside(const std::string& name, std::size_t constraint) {
  constexpr std::size_t longest = 36;
  return name.size() <= longest ? plain(name) : "λ_{" + std::to_string(constraint + 1) + "}";
}

Panel multipliers_panel(const Recording& recording) {
  Panel panel = against_time("Lagrange multipliers", {"λ"});
  const std::vector<std::size_t> shown = shown_multipliers(recording);
  const std::vector<std::string> names = multiplier_names(recording);
  for (std::size_t n = 0; n < shown.size(); ++n)
    panel.curves.push_back(range_of(beside(names[n], shown[n]), recording, shown[n], &Recording::Sample::lambda,
                                    &Recording::Sample::least_lambda, &Recording::Sample::greatest_lambda));
  return panel;
}

Panel observation_panel(const Recording& recording, std::size_t i) {
  const std::string name = plain(recording.observations[i]);
  Panel panel = against_time(name, {name});
  panel.curves.push_back(range_of("", recording, i, &Recording::Sample::observed, &Recording::Sample::least_observed,
                                  &Recording::Sample::greatest_observed));
  return panel;
}

Panel portrait_panel(const Recording& recording, const Portrait& portrait) {
  std::array<std::size_t, 2> numbers{};
  for (std::size_t j = 0; j < 2; ++j)
    numbers[j] =
        static_cast<std::size_t>(std::find(recording.observations.begin(), recording.observations.end(), portrait[j]) -
                                 recording.observations.begin());
  Panel panel;
  panel.x.label = plain(portrait[0]);
  panel.y.label = plain(portrait[1]);
  panel.title = panel.y.label + " against " + panel.x.label;
  Curve& curve = panel.curves.emplace_back();
  for (const Recording::Sample& sample : recording.samples)
    curve.points.push_back({sample.observed.at(numbers[0]), sample.observed.at(numbers[1])});
  return panel;
}

Panel energy_panel(const Recording& recording) {
  Panel panel = against_time("Error of energy, linear", {recording.conserved + " − H_0"});
  panel.curves.push_back(curve_of("", recording, [](const auto& sample) { return sample.H_change; }));
  return panel;
}

Panel errors_panel(const Recording& recording) {
  Panel panel = against_time("Errors of energy and constraints", {"error", AxisScale::decimal});
  if (std::isfinite(recording.round_off)) panel.round_off = recording.round_off;
  panel.curves.push_back(
      curve_of("|" + recording.conserved + " − H_0|", recording, [](const auto& sample) { return sample.energy; }));
  if (recording.constraints.empty()) return panel;
  panel.curves.push_back(curve_of("|g|", recording, [](const auto& sample) { return sample.constraints; }));
  panel.curves.push_back(curve_of("hidden", recording, [](const auto& sample) { return sample.hidden; }));
  return panel;
}

/// The digits of each precision that an error of the start has left.
Panel horizon_panel(const Recording& recording) {
  const DigitsLost& horizon = *recording.horizon;
  Panel panel = against_time("Digits of the start that are left", {"digits"});
  panel.labels_beside = true;
  for (const Horizon& one : horizon.horizons)
    panel.curves.push_back(curve_of(one.precision, recording, [&](const auto& sample) {
      return std::max(double{0}, one.digits - lost_by(horizon, sample.t));
    }));
  return panel;
}

/// On a line: where each body is at each time.
Panel world_lines(const Sketch& sketch, const Recording& recording) {
  Panel panel = against_time("Motion", {"x"});
  for (std::size_t i = 0; i < sketch.places.size(); ++i)
    if (sketch.places[i].has_mass)
      panel.curves.push_back(curve_of(plain(sketch.places[i].name), recording,
                                      [&sketch, i](const auto& sample) { return sketch.position(i, sample.q)[0]; }));
  return panel;
}

/// On a line, in the plane, or along two axes.
std::vector<Panel> motion_panels(const Sketch& sketch, const Recording& recording, const std::string& title) {
  std::vector<Panel> panels;
  if (sketch.dimension == 1 && recording.samples.size() > 1) return {world_lines(sketch, recording)};
  if (sketch.dimension < 3) {
    panels.push_back(motion_panel(sketch, recording, {0, 1}));
    panels.back().title = title;
    return panels;
  }
  for (const Projection& seen : {Projection{0, 1}, Projection{0, 2}}) {
    panels.push_back(motion_panel(sketch, recording, seen));
    panels.back().title = title + ", seen along " + axes[3 - seen.across - seen.up];
  }
  return panels;
}

/// The lower left and the upper right corner of what these points take.
std::vector<PlotPoint> corners_of(const std::vector<PlotPoint>& points) {
  constexpr double far = std::numeric_limits<double>::infinity();
  PlotPoint low{far, far}, high{-far, -far};
  for (const PlotPoint& point : points)
    for (std::size_t j = 0; j < 2; ++j) {
      if (!std::isfinite(point[j])) continue;
      low[j] = std::min(low[j], point[j]);
      high[j] = std::max(high[j], point[j]);
    }
  return {low, high};
}

}  // namespace

Panel motion_panel(const Sketch& sketch, const Recording& recording, const Projection& projection) {
  Panel panel;
  panel.equal_axes = true;
  panel.x.label = axes[projection.across];
  panel.y.label = axes[projection.up];
  add_lines(panel, sketch.held_on.meshes, projection, Polyline::Look::mesh);
  add_lines(panel, sketch.held_on.curves, projection, Polyline::Look::faint);
  const std::vector<double>&first = recording.samples.front().q, &last = recording.samples.back().q;
  constexpr std::size_t most_labels = 12;
  std::size_t moving = 0;
  for (const Sketch::Place& place : sketch.places) moving += place.has_mass ? 1 : 0;
  for (std::size_t i = 0; i < sketch.places.size(); ++i) {
    const Sketch::Place& place = sketch.places[i];
    const PlotPoint at = project(sketch.position(i, last), projection);
    const std::string label = moving <= most_labels && place.labelled ? place.name : "";
    if (place.has_mass) {
      panel.curves.push_back(path_of(sketch, i, recording, projection));
      panel.marks.push_back({project(sketch.position(i, first), projection), Mark::Look::start, ""});
    }
    if (projection.end || !moves(place)) add_marks(panel, place, at, label, std::nullopt);
  }
  const auto samples = static_cast<long>(recording.samples.size());
  for (long n = 1; n <= projection.rods; ++n)
    add_links(panel, sketch, recording.samples[static_cast<std::size_t>(n * samples / (projection.rods + 1))].q,
              projection, Polyline::Look::faint);
  add_links(panel, sketch, first, projection, Polyline::Look::dashed);
  if (projection.end) add_links(panel, sketch, last, projection, Polyline::Look::solid);
  return panel;
}

void add_state(Panel& panel, const Sketch& sketch, const std::vector<double>& q, const Projection& projection,
               std::size_t colour) {
  for (std::size_t i = 0; i < sketch.places.size(); ++i)
    if (moves(sketch.places[i]))
      add_marks(panel, sketch.places[i], project(sketch.position(i, q), projection), "", colour);
  const std::size_t before = panel.lines.size();
  add_links(panel, sketch, q, projection, Polyline::Look::solid, colour);
  for (std::size_t i = before; i < panel.lines.size(); ++i) panel.lines[i].dashed = true;
}

Figure run_figure(const Sketch& sketch, const Recording& recording, const std::vector<Portrait>& portraits,
                  bool linear_energy) {
  const Recording seen = recording.until_lost();
  const bool whole = seen.samples.size() == recording.samples.size();
  Figure figure;
  figure.panels =
      motion_panels(sketch, seen, whole ? "Motion" : fmt::format("Motion until {:.4g}", seen.samples.back().t));
  for (const Portrait& portrait : portraits) figure.panels.push_back(portrait_panel(seen, portrait));
  for (std::size_t i = 0; i < recording.observations.size(); ++i)
    if (std::none_of(portraits.begin(), portraits.end(), [&](const Portrait& portrait) {
          return std::count(portrait.begin(), portrait.end(), recording.observations[i]) > 0;
        }))
      figure.panels.push_back(observation_panel(recording, i));
  if (!recording.constraints.empty()) figure.panels.push_back(multipliers_panel(recording));
  if (linear_energy) figure.panels.push_back(energy_panel(recording));
  figure.panels.push_back(errors_panel(recording));
  if (recording.horizon) figure.panels.push_back(horizon_panel(recording));
  return figure;
}

std::vector<Figure> motion_frames(const Sketch& sketch, const Recording& recording) {
  constexpr std::size_t most = 120;
  Recording whole = recording.until_lost();
  // Every frame has the path anew. So many samples make no corners in it, and need no points between them.
  constexpr std::size_t smooth = 300;
  if (whole.samples.size() >= smooth)
    for (Recording::Sample& sample : whole.samples) sample.v.clear();
  const std::size_t last = whole.samples.size() - 1, count = std::min(most, last);
  std::vector<Figure> frames;
  std::vector<std::vector<PlotPoint>> room;
  Recording part = whole;
  part.samples.clear();
  for (std::size_t n = 1; n <= count; ++n) {
    const auto sample = [&](std::size_t i) { return whole.samples.begin() + static_cast<std::ptrdiff_t>(i); };
    part.samples.insert(part.samples.end(), sample(part.samples.size()), sample(n * last / count + 1));
    Figure& frame = frames.emplace_back();
    frame.panels = motion_panels(sketch, part, fmt::format("t = {:.3f}", part.samples.back().t));
    room.resize(frame.panels.size());
    for (std::size_t i = 0; i < frame.panels.size(); ++i) {
      const Panel& panel = frame.panels[i];
      for (const Curve& curve : panel.curves) room[i].insert(room[i].end(), curve.points.begin(), curve.points.end());
      for (const Polyline& line : panel.lines) room[i].insert(room[i].end(), line.points.begin(), line.points.end());
      for (const Mark& mark : panel.marks) room[i].push_back(mark.at);
      room[i] = corners_of(room[i]);
    }
  }
  for (Figure& frame : frames)
    for (std::size_t i = 0; i < frame.panels.size(); ++i) frame.panels[i].room_for = room[i];
  return frames;
}

Figure scene_figure(const Sketch& sketch, const std::vector<double>& q) {
  Recording start;
  start.samples.emplace_back().q = q;
  Figure figure;
  figure.panels = motion_panels(sketch, start, "Start");
  return figure;
}

}  // namespace hbvm::core
