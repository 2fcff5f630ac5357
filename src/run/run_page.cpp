#include "run/run_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "hbvm/figure.hpp"
#include "hbvm/version.hpp"
#include "long_work/json.hpp"
#include "report/axis_range.hpp"
#include "report/html.hpp"
#include "run/page_parts.hpp"
#include "scene/sketch.hpp"

namespace hbvm::core {
namespace {

/// As JavaScript's Number() reads it: JSON has no infinite numbers.
OrderedJson any_number(double x) {
  if (std::isnan(x)) return "NaN";
  if (std::isinf(x)) return x > 0 ? "Infinity" : "-Infinity";
  return x;
}

OrderedJson numbers_of(const std::vector<double>& values) {
  OrderedJson list = OrderedJson::array();
  for (const double value : values) list.push_back(any_number(value));
  return list;
}

OrderedJson json_of(const Sketch& sketch) {
  OrderedJson places = OrderedJson::array(), links = OrderedJson::array();
  for (const Sketch::Place& place : sketch.places) {
    OrderedJson blocks = OrderedJson::array();
    for (const auto& block : place.at.blocks) blocks.push_back({block.offset, any_number(block.weight)});
    places.push_back({{"name", place.name},
                      {"blocks", blocks},
                      {"shift", numbers_of({place.at.shift.begin(), place.at.shift.end()})},
                      {"has_mass", place.has_mass},
                      {"charge", any_number(place.charge)},
                      {"labelled", place.labelled}});
  }
  for (const Sketch::Link& link : sketch.links) {
    const char* const as = link.as == Sketch::Joins::rod ? "rod" : link.as == Sketch::Joins::spring ? "spring" : "body";
    links.push_back({link.a, link.b, as});
  }
  return {{"dimension", sketch.dimension}, {"places", places}, {"links", links}};
}

/// What is no number exceeds all numbers: it must be seen.
double greater(double a, double b) { return std::isnan(b) || b > a ? b : a; }

/// Every k-th sample and the last, with the greatest errors since the one before.
Recording thinned(const Recording& recording, std::size_t k) {
  Recording result = recording;
  result.every *= static_cast<long>(k);
  result.samples.clear();
  const double none = -std::numeric_limits<double>::infinity();
  double energy = none, constraints = none, hidden = none;
  for (std::size_t i = 0; i < recording.samples.size(); ++i) {
    const Recording::Sample& sample = recording.samples[i];
    energy = greater(energy, sample.energy);
    constraints = greater(constraints, sample.constraints);
    hidden = greater(hidden, sample.hidden);
    if (i % k != 0 && i + 1 != recording.samples.size()) continue;
    result.samples.push_back({sample.t, sample.q, sample.lambda, energy, constraints, hidden});
    energy = constraints = hidden = none;
  }
  return result;
}

/// A column of the samples that a chart shows.
struct PageCurve {
  std::string name;
  std::vector<double> values;
  std::size_t number = 0;  ///< of its constraint, from 1
};

OrderedJson json_of(const AxisRange& range, const Tics& tics) {
  OrderedJson list = OrderedJson::array();
  for (const Tic& tic : tics.tics)
    if (!tic.text.empty()) list.push_back({tic.at, tic.text});
  return {{"range", {range.from, range.to}}, {"factor", tics.factor}, {"tics", list}};
}

/// The samples as rows: t, q, the values of the curves; and where each chart finds its own.
class PageData {
 public:
  explicit PageData(const Recording& recording) {
    for (const Recording::Sample& sample : recording.samples) {
      OrderedJson row = OrderedJson::array({any_number(sample.t)});
      for (const double x : sample.q) row.push_back(any_number(x));
      rows_.push_back(std::move(row));
    }
    columns_ = 1 + recording.samples.front().q.size();
    const auto curve = [&](const std::string& name, const auto& value) {
      PageCurve result{name, {}, 0};
      for (const Recording::Sample& sample : recording.samples) result.values.push_back(value(sample));
      return result;
    };
    std::vector<PageCurve> multipliers;
    for (const std::size_t i : shown_multipliers(recording)) {
      multipliers.push_back(curve(recording.constraints[i], [i](const auto& sample) { return sample.lambda[i]; }));
      multipliers.back().number = i + 1;
    }
    if (!multipliers.empty()) add("Lagrange multipliers", "λ", AxisScale::linear, multipliers);
    std::vector<PageCurve> errors{curve("|H − H₀|", [](const auto& sample) { return sample.energy; })};
    if (!recording.constraints.empty()) {
      errors.push_back(curve("|g|", [](const auto& sample) { return sample.constraints; }));
      errors.push_back(curve("hidden", [](const auto& sample) { return sample.hidden; }));
    }
    add("Errors of energy and constraints", "error", AxisScale::decimal, errors);
    const AxisRange time = range_of(curve("t", [](const auto& sample) { return sample.t; }).values);
    time_ = json_of(time, tics_of(time, AxisScale::linear, most_tics));
  }

  OrderedJson json() const { return {{"time", time_}, {"charts", charts_}, {"samples", rows_}}; }

 private:
  static constexpr int most_tics = 7;

  void add(const std::string& title, const std::string& symbol, AxisScale scale, const std::vector<PageCurve>& curves) {
    constexpr double room = 1 / double{25};
    std::vector<double> all;
    OrderedJson list = OrderedJson::array();
    for (const PageCurve& curve : curves) {
      all.insert(all.end(), curve.values.begin(), curve.values.end());
      for (std::size_t i = 0; i < rows_.size(); ++i) rows_[i].push_back(any_number(curve.values[i]));
      list.push_back({{"name", curve.name}, {"column", columns_++}});
      if (curve.number > 0) list.back()["number"] = curve.number;
    }
    const AxisRange range = widened(range_of(all), room);
    OrderedJson chart = json_of(range, tics_of(range, scale, most_tics));
    chart["title"] = title;
    chart["symbol"] = symbol;
    chart["decimal"] = scale == AxisScale::decimal;
    chart["curves"] = list;
    charts_.push_back(std::move(chart));
  }

  std::size_t columns_ = 0;
  std::vector<OrderedJson> rows_;
  OrderedJson charts_ = OrderedJson::array(), time_;
};

/// 12 000
std::string grouped(long n) {
  constexpr long short_enough = 10'000;
  if (n < short_enough) return std::to_string(n);
  std::string digits = std::to_string(n);
  for (auto at = static_cast<long>(digits.size()) - 3; at > 0; at -= 3)
    digits.insert(static_cast<std::size_t>(at), "\u00A0");
  return digits;
}

std::string ordinal(long n) {
  const long last = n % 10, teens = n % 100 / 10;
  return grouped(n) + (teens == 1 ? "th" : last == 1 ? "st" : last == 2 ? "nd" : last == 3 ? "rd" : "th");
}

/// The step that the last sample is after: that of the end, unless the run failed on the way.
long last_step(const Recording& recording) {
  return std::min(recording.steps, recording.every * (static_cast<long>(recording.samples.size()) - 1));
}

/// What is seen of the run, and whether it came to its end. \param last the step that it came to
std::string account_of(const Recording& recording, long last) {
  std::string text =
      recording.every == 1
          ? fmt::format("Every state of {} step{}.", grouped(recording.steps), recording.steps == 1 ? "" : "s")
          : fmt::format(
                "Every {} of {} steps, and the last; each error is the greatest since the "
                "state shown before it.",
                ordinal(recording.every), grouped(recording.steps));
  if (last < recording.steps)
    text += fmt::format(" The run ended early: what is shown ends at t = {:.6g}.", recording.samples.back().t);
  return text;
}

/// A text with each {{name}} in it replaced; what is put there is not looked at again.
std::string filled(std::string_view form, const std::map<std::string, std::string, std::less<>>& words) {
  constexpr std::string_view open = "{{", close = "}}";
  std::string result;
  for (;;) {
    const std::size_t at = form.find(open), end = form.find(close, at);
    if (end == std::string_view::npos) return result.append(form);
    result.append(form.substr(0, at));
    result += words.find(form.substr(at + open.size(), end - at - open.size()))->second;
    form.remove_prefix(end + close.size());
  }
}

/// −4, −(1 + pi)
std::string negative(const std::string& text) {
  return text.find_first_of("+-") == std::string::npos ? "−" + text : "−(" + text + ")";
}

/// A scene that would fill the page is cut.
std::string scene_on_page(const Scene& scene) {
  constexpr std::size_t most = run_page_bytes / 10;
  std::string text = write_scene(scene);
  if (text.size() <= most) return text;
  const std::size_t end = text.rfind('\n', most) + 1, rest = text.size() - end;
  return text.substr(0, end) + "# … and " + grouped(static_cast<long>(rest)) + " bytes more\n";
}

}  // namespace

bool is_page(const std::string& file) { return file.ends_with(".html"); }

std::string run_page(const RunRequest& request, const Recording& recording, const std::string& command) {
  const PageParts& parts = page_parts();
  if (parts.dygraphs.empty())
    throw InputError("this build has no dygraphs, which draws the curves of a run's page; write .svg or .png instead");
  const OrderedJson drawn = json_of(sketch(request.scene));
  OrderedJson colours = OrderedJson::array();
  for (const std::string_view colour : curve_colours) colours.push_back(colour);
  const bool backward = request.direction == Direction::backward;
  std::map<std::string, std::string, std::less<>> words{
      {"title", html(request.scene.title)},
      {"name", html(request.scene.name)},
      {"method", html(request.method->text())},
      {"precision", html(request.precision.name())},
      {"step", html(request.step.text())},
      {"until", html(backward ? negative(request.until.text()) : request.until.text())},
      {"program", html(std::string("hbvm ") + version())},
      {"command", html(command)},
      {"scene", html(scene_on_page(request.scene))},
      {"style", parts.dygraphs_style + parts.style},
      {"dygraphs", parts.dygraphs},
      {"script", parts.script}};
  // As many samples as there is room for.
  for (std::size_t k = 1;; ++k) {
    const Recording shown = thinned(recording, k);
    OrderedJson data{{"colours", colours},
                     {"every", shown.every},
                     {"steps", shown.steps},
                     {"last_step", last_step(recording)},
                     {"sketch", drawn}};
    data.update(PageData(shown).json());
    words["account"] = html(account_of(shown, last_step(recording)));
    words["data"] = within_script(dumped(data, -1));
    std::string page = filled(parts.html, words);
    if (page.size() < run_page_bytes) return page;
    if (shown.samples.size() <= 2)
      throw Error(fmt::format("'{}' has {} coordinates, too many for a page of less than {} bytes: use --plot FILE.svg",
                              request.scene.name, shown.samples.front().q.size(), run_page_bytes));
  }
}

}  // namespace hbvm::core
