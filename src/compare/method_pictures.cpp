#include "compare/method_pictures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "hbvm/version.hpp"
#include "run/run_figure.hpp"
#include "run/run_page.hpp"
#include "scene/sketch.hpp"

namespace hbvm::core {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// The farthest that what has mass gets from the origin and from its start, up to each sample; not a number is far.
std::vector<double> reach(const Sketch& sketch, const Recording& recording) {
  std::vector<double> farthest;
  double most = 0;
  for (const Recording::Sample& sample : recording.samples) {
    for (std::size_t i = 0; i < sketch.places.size(); ++i) {
      if (!sketch.places[i].has_mass) continue;
      const std::array<double, 3> x = sketch.position(i, sample.q),
                                  from = sketch.position(i, recording.samples.front().q);
      const double r = std::hypot(x[0] - from[0], x[1] - from[1], x[2] - from[2]);
      most = std::isnan(r) ? std::numeric_limits<double>::infinity() : std::max(most, r);
    }
    farthest.push_back(most);
  }
  return farthest;
}

/// Positions of a motion that went too far are not to be seen from there on.
std::vector<Recording> until_they_leave(const Sketch& sketch, const std::vector<RecordedMethod>& runs) {
  constexpr double too_far = 3;
  double calmest = std::numeric_limits<double>::infinity();
  std::vector<std::vector<double>> reaches;
  for (const RecordedMethod& run : runs) {
    reaches.push_back(reach(sketch, run.recording));
    if (run.figures.failure.empty()) calmest = std::min(calmest, reaches.back().back());
  }
  std::vector<Recording> shown;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    Recording& recording = shown.emplace_back(runs[i].recording);
    for (std::size_t n = 0; n < recording.samples.size(); ++n)
      if (reaches[i][n] > too_far * calmest)
        std::fill(recording.samples[n].q.begin(), recording.samples[n].q.end(), nothing);
  }
  return shown;
}

/// The scene as all motions go through it, and what is shown of them.
std::pair<Sketch, std::vector<Recording>> sketched(const Scene& scene, const std::vector<RecordedMethod>& runs) {
  std::vector<Recording> shown = until_they_leave(sketch(scene), runs);
  std::vector<std::vector<double>> states;
  for (const Recording& recording : shown)
    for (std::vector<double>& q : recording.states()) states.push_back(std::move(q));
  return {sketch(scene, states), std::move(shown)};
}

/// An error of a run, as panels and charts show it.
struct ErrorCurve {
  const char* title;
  const char* symbol;
  AxisScale scale;
  double Recording::Sample::*value;
};

std::vector<ErrorCurve> error_curves(const Recording& recording) {
  std::vector<ErrorCurve> curves{
      {"Error of energy, |H − H₀|", "|H − H_0|", AxisScale::decimal, &Recording::Sample::energy},
      {"The same, linear: H − H₀", "H − H_0", AxisScale::linear, &Recording::Sample::H_change}};
  if (recording.constraints.empty()) return curves;
  curves.push_back({"Error of constraints, |g|", "|g|", AxisScale::decimal, &Recording::Sample::constraints});
  curves.push_back({"Error of hidden constraints", "hidden", AxisScale::decimal, &Recording::Sample::hidden});
  return curves;
}

/// Where its axis ends, if it is one of powers.
std::optional<double> round_off_of(const ErrorCurve& error, const Recording& recording) {
  if (error.scale != AxisScale::decimal || !std::isfinite(recording.round_off)) return std::nullopt;
  return recording.round_off;
}

/// The paths of one motion as a curve with gaps between them.
Curve joined(const Panel& panel, const std::string& label) {
  Curve curve{label, {}};
  for (const Curve& path : panel.curves) {
    if (!curve.points.empty()) curve.points.push_back({nothing, nothing});
    curve.points.insert(curve.points.end(), path.points.begin(), path.points.end());
  }
  return curve;
}

/// The last state of a motion that is to be seen, if there is one.
const std::vector<double>* last_seen(const Recording& recording) {
  for (auto sample = recording.samples.rbegin(); sample != recording.samples.rend(); ++sample)
    if (std::all_of(sample->q.begin(), sample->q.end(), [](double x) { return std::isfinite(x); })) return &sample->q;
  return nullptr;
}

/// Paths over one another, and each motion's bodies where it was last seen.
Panel motions_panel(const Sketch& sketch, const std::vector<RecordedMethod>& runs, const std::vector<Recording>& shown,
                    const Projection& seen, const std::string& title) {
  const Projection without_end{seen.across, seen.up, 0, false};
  Panel all;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    Panel one = motion_panel(sketch, shown[i], without_end);
    const Curve paths = joined(one, plain(runs[i].figures.method));
    if (i == 0) {
      all = std::move(one);
      all.curves.clear();
    }
    all.curves.push_back(paths);
    if (const std::vector<double>* const q = last_seen(shown[i])) add_state(all, sketch, *q, seen, i);
  }
  all.title = title;
  all.labels_beside = true;
  return all;
}

/// The scene once for each motion, with its coordinates after those of the ones before.
void add_motion(MovingPage& page, const Sketch& sketch, const std::string& method, int colour,
                std::size_t coordinates) {
  const auto first = page.sketch.places.size();
  const bool is_alone =
      std::count_if(sketch.places.begin(), sketch.places.end(), [](const auto& place) { return place.has_mass; }) == 1;
  for (const Sketch::Place& place : sketch.places) {
    Sketch::Place& added = page.sketch.places.emplace_back(place);
    for (auto& block : added.at.blocks) block.offset += static_cast<Index>(coordinates) * colour;
    const bool moves = added.of || !added.at.blocks.empty();
    if (moves) added.name = is_alone ? method : place.name + " (" + method + ")";
    if (!moves && colour > 0) added.labelled = false;
    if (added.of) *added.of += first;
    page.colours.push_back(moves ? colour : -1);
  }
  for (const Sketch::Link& link : sketch.links) page.sketch.links.push_back({first + link.a, first + link.b, link.as});
  for (const Sketch::Body& body : sketch.bodies) {
    Sketch::Body& added = page.sketch.bodies.emplace_back(body);
    added.place += first;
    for (auto& block : added.reference.blocks) block.offset += static_cast<Index>(coordinates) * colour;
    for (Index& director : added.directors) director += static_cast<Index>(coordinates) * colour;
  }
}

}  // namespace

Figure methods_figure(const RunRequest& request, const std::vector<RecordedMethod>& runs, const std::string& command) {
  const auto [drawn, shown] = sketched(request.scene, runs);
  Figure figure;
  figure.caption = plain(request.scene.title);
  figure.footnote = std::string("hbvm ") + version() + ": " + command;
  figure.panels.push_back(
      motions_panel(drawn, runs, shown, {0, 1}, drawn.dimension == 3 ? "Motion, seen along z" : "Motion"));
  if (drawn.dimension == 3) figure.panels.push_back(motions_panel(drawn, runs, shown, {0, 2}, "Motion, seen along y"));
  for (const ErrorCurve& error : error_curves(shown.front())) {
    Panel& panel = figure.panels.emplace_back();
    panel.title = error.title;
    panel.x.label = "t";
    panel.y = {error.symbol, error.scale};
    panel.round_off = round_off_of(error, shown.front());
    panel.labels_beside = true;
    for (std::size_t i = 0; i < runs.size(); ++i) {
      Curve& curve = panel.curves.emplace_back(Curve{plain(runs[i].figures.method), {}});
      for (const Recording::Sample& sample : shown[i].samples) curve.points.push_back({sample.t, sample.*error.value});
    }
  }
  return figure;
}

std::string methods_page(const RunRequest& request, const std::vector<RecordedMethod>& runs,
                         const std::string& command) {
  MovingPage page = page_about(request, command);
  const auto [drawn, shown] = sketched(request.scene, runs);
  page.method.clear();
  page.sketch.dimension = drawn.dimension;
  page.sketch.held_on = drawn.held_on;
  const Recording* longest = &shown.front();
  for (const Recording& recording : shown)
    if (recording.samples.size() > longest->samples.size()) longest = &recording;
  const std::size_t m = longest->samples.front().q.size();
  for (const Recording::Sample& sample : longest->samples) {
    page.t.push_back(sample.t);
    page.q.emplace_back(m * shown.size(), nothing);
    page.v.push_back(page.q.back());
  }
  for (const ErrorCurve& error : error_curves(*longest)) {
    page.charts.push_back({error.title, error.symbol, error.scale, {}});
    page.charts.back().round_off = round_off_of(error, *longest);
  }
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const std::string& method = runs[i].figures.method;
    page.method += (i > 0 ? ", " : "") + method;
    add_motion(page, drawn, method, static_cast<int>(i), m);
    const std::vector<Recording::Sample>& samples = shown[i].samples;
    for (std::size_t n = 0; n < samples.size(); ++n) {
      const auto at = static_cast<std::ptrdiff_t>(i * m);
      std::copy(samples[n].q.begin(), samples[n].q.end(), page.q[n].begin() + at);
      std::copy(samples[n].v.begin(), samples[n].v.end(), page.v[n].begin() + at);
    }
    const std::vector<ErrorCurve> errors = error_curves(*longest);
    for (std::size_t e = 0; e < errors.size(); ++e) {
      PageCurve& curve = page.charts[e].curves.emplace_back(PageCurve{method, {}});
      curve.is_error = errors[e].scale == AxisScale::decimal;
      for (std::size_t n = 0; n < page.t.size(); ++n)
        curve.values.push_back(n < samples.size() ? samples[n].*errors[e].value : nothing);
    }
  }
  page.every = longest->every;
  page.steps = longest->steps;
  page.last_step = last_step(*longest);
  return moving_page(page);
}

}  // namespace hbvm::core
