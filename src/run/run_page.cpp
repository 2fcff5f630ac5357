#include "run/run_page.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "run/horizon.hpp"
#include "run/multiplier_names.hpp"
#include "scene/sketch.hpp"

namespace hbvm::core {
namespace {

/// −4, −(1 + pi)
std::string negative(const std::string& text) {
  return text.find_first_of("+-") == std::string::npos ? "−" + text : "−(" + text + ")";
}

PageCurve curve_of(const std::string& name, const Recording& recording, double Recording::Sample::*value) {
  PageCurve curve{name, {}, 0, true};
  for (const Recording::Sample& sample : recording.samples) curve.values.push_back(sample.*value);
  return curve;
}

PageChart multipliers_of(const Recording& recording) {
  PageChart chart{"Lagrange multipliers", "λ", AxisScale::linear, {}};
  const std::vector<std::string> names = multiplier_names(recording);
  for (const std::size_t i : shown_multipliers(recording)) {
    PageCurve& curve = chart.curves.emplace_back(PageCurve{recording.constraints[i], {}, i + 1});
    curve.label = names[chart.curves.size() - 1];
    for (const Recording::Sample& sample : recording.samples) curve.values.push_back(sample.lambda[i]);
  }
  return chart;
}

PageChart chart_of(const Recording& recording, std::size_t observation) {
  const std::string& name = recording.observations[observation];
  PageChart chart{name, name, AxisScale::linear, {PageCurve{name, {}}}};
  for (const Recording::Sample& sample : recording.samples)
    chart.curves.front().values.push_back(sample.observed[observation]);
  return chart;
}

PageChart errors_of(const Recording& recording) {
  PageChart chart{"Errors of energy and constraints", "error", AxisScale::decimal, {}};
  if (std::isfinite(recording.round_off)) chart.round_off = recording.round_off;
  chart.curves.push_back(curve_of("|" + recording.conserved + " − H₀|", recording, &Recording::Sample::energy));
  if (recording.constraints.empty()) return chart;
  chart.curves.push_back(curve_of("|g|", recording, &Recording::Sample::constraints));
  chart.curves.push_back(curve_of("hidden", recording, &Recording::Sample::hidden));
  return chart;
}

PageChart digits_left_of(const Recording& recording) {
  const DigitsLost& horizon = *recording.horizon;
  PageChart chart{"Digits of the start that are left", "digits", AxisScale::linear, {}};
  for (const Horizon& one : horizon.horizons) {
    PageCurve& curve = chart.curves.emplace_back(PageCurve{one.precision, {}});
    for (const Recording::Sample& sample : recording.samples)
      curve.values.push_back(std::max(double{0}, one.digits - lost_by(horizon, sample.t)));
  }
  return chart;
}

PageChart energy_of(const Recording& recording) {
  PageChart chart{"Error of energy, linear", recording.conserved + " − H₀", AxisScale::linear, {}};
  chart.curves.push_back(curve_of(chart.symbol, recording, &Recording::Sample::H_change));
  chart.curves.front().is_error = false;
  return chart;
}

}  // namespace

bool is_page(const std::string& file) { return file.ends_with(".html"); }

long last_step(const Recording& recording) {
  return std::min(recording.steps, recording.every * (static_cast<long>(recording.samples.size()) - 1));
}

MovingPage page_about(const RunRequest& request, const std::string& command) {
  const bool backward = request.direction == Direction::backward;
  MovingPage page;
  page.title = request.scene.title;
  page.name = request.scene.name;
  page.method = request.method->text();
  page.precision = request.precision.name();
  page.step = request.step.text();
  page.until = backward ? negative(request.until.text()) : request.until.text();
  page.scene = write_scene(request.scene);
  page.command = command;
  return page;
}

std::string run_page(const RunRequest& request, const Recording& recording, const std::string& command) {
  MovingPage page = page_about(request, command);
  const std::vector<std::vector<double>> seen = recording.until_lost().states();
  page.sketch = sketch(request.scene, seen);
  for (const Recording::Sample& sample : recording.samples) page.t.push_back(sample.t);
  page.q = recording.states();
  for (const Recording::Sample& sample : recording.samples)
    if (!sample.v.empty()) page.v.push_back(sample.v);
  for (std::size_t n = seen.size(); n < page.q.size(); ++n)
    std::fill(page.q[n].begin(), page.q[n].end(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < recording.observations.size(); ++i) page.charts.push_back(chart_of(recording, i));
  if (!shown_multipliers(recording).empty()) page.charts.push_back(multipliers_of(recording));
  if (request.linear_energy) page.charts.push_back(energy_of(recording));
  page.charts.push_back(errors_of(recording));
  if (recording.horizon) page.charts.push_back(digits_left_of(recording));
  page.every = recording.every;
  page.steps = recording.steps;
  page.last_step = last_step(recording);
  return moving_page(page);
}

}  // namespace hbvm::core
