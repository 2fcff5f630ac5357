#include "run/moving_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>

#include "hbvm/error.hpp"
#include "hbvm/version.hpp"
#include "long_work/json.hpp"
#include "report/axis_range.hpp"
#include "report/html.hpp"
#include "run/page_parts.hpp"

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

/// No more digits than are seen.
double as_drawn(double x) { return std::strtod(fmt::format("{:.5g}", x).c_str(), nullptr); }

OrderedJson json_of(const std::vector<std::array<double, 3>>& points) {
  OrderedJson list = OrderedJson::array();
  for (const std::array<double, 3>& point : points)
    list.push_back({as_drawn(point[0]), as_drawn(point[1]), as_drawn(point[2])});
  return list;
}

/// Edges as two corners, the faces at their sides, and 1 for a sharp one.
OrderedJson json_of(const Solid& solid) {
  OrderedJson edges = OrderedJson::array();
  for (const Solid::Edge& edge : solid.edges)
    edges.push_back({edge.ends[0], edge.ends[1], edge.faces[0], edge.faces[1], edge.sharp ? 1 : 0});
  return {{"corners", json_of(solid.corners)}, {"faces", solid.faces}, {"edges", edges}, {"closed", solid.closed}};
}

OrderedJson json_of(const Displacement<double>& x) {
  OrderedJson blocks = OrderedJson::array();
  for (const auto& block : x.blocks) blocks.push_back({block.offset, any_number(block.weight)});
  return {{"blocks", blocks}, {"shift", numbers_of({x.shift.begin(), x.shift.end()})}};
}

OrderedJson json_of(const Sketch::Place& place) {
  OrderedJson json = json_of(place.at);
  json["name"] = place.name;
  json["has_mass"] = place.has_mass;
  json["charge"] = any_number(place.charge);
  json["labelled"] = place.labelled;
  using Mark = Sketch::Place::Mark;
  json["mark"] = place.mark == Mark::joint ? "joint" : place.mark == Mark::none ? "none" : "dot";
  if (place.of) json["of"] = *place.of;
  return json;
}

/// Rigid bodies, and their solids: each that differs is there once.
void add_bodies(OrderedJson& json, const Sketch& sketch) {
  OrderedJson bodies = OrderedJson::array(), solids = OrderedJson::array();
  for (const Sketch::Body& body : sketch.bodies) {
    const OrderedJson solid = json_of(body.solid);
    const auto known = std::find(solids.begin(), solids.end(), solid);
    OrderedJson added = json_of(body.reference);
    added["place"] = body.place;
    added["directors"] = body.directors;
    added["solid"] = known - solids.begin();
    bodies.push_back(added);
    if (known == solids.end()) solids.push_back(solid);
  }
  json["bodies"] = bodies;
  json["solids"] = solids;
}

OrderedJson json_of(const Sketch& sketch, const std::vector<int>& colours) {
  OrderedJson places = OrderedJson::array(), links = OrderedJson::array(), meshes = OrderedJson::array(),
              curves = OrderedJson::array();
  for (const Sketch::Place& place : sketch.places) {
    places.push_back(json_of(place));
    if (!colours.empty()) places.back()["colour"] = colours[places.size() - 1];
  }
  for (const Sketch::Link& link : sketch.links) {
    using Joins = Sketch::Joins;
    const char* const as = link.as == Joins::rod      ? "rod"
                           : link.as == Joins::spring ? "spring"
                           : link.as == Joins::axis   ? "axis"
                                                      : "body";
    links.push_back({link.a, link.b, as});
  }
  for (const PointLine& line : sketch.held_on.meshes) meshes.push_back(json_of(line));
  for (const PointLine& line : sketch.held_on.curves) curves.push_back(json_of(line));
  OrderedJson json{
      {"dimension", sketch.dimension}, {"places", places}, {"links", links}, {"meshes", meshes}, {"curves", curves}};
  add_bodies(json, sketch);
  return json;
}

/// What is no number exceeds all numbers: it must be seen.
double greater(double a, double b) { return std::isnan(b) || b > a ? b : a; }

/// Every k-th value and the last; of errors the greatest since the one before.
std::vector<double> thinned(const std::vector<double>& values, std::size_t k, bool is_error) {
  constexpr double none = -std::numeric_limits<double>::infinity();
  std::vector<double> kept;
  double since = none;
  for (std::size_t i = 0; i < values.size(); ++i) {
    since = is_error ? greater(since, values[i]) : values[i];
    if (i % k != 0 && i + 1 != values.size()) continue;
    kept.push_back(since);
    since = none;
  }
  return kept;
}

/// Every k-th and the last.
std::vector<std::vector<double>> thinned(const std::vector<std::vector<double>>& states, std::size_t k) {
  std::vector<std::vector<double>> kept;
  for (std::size_t i = 0; i < states.size(); ++i)
    if (i % k == 0 || i + 1 == states.size()) kept.push_back(states[i]);
  return kept;
}

MovingPage thinned(const MovingPage& page, std::size_t k) {
  if (k == 1) return page;
  MovingPage result = page;
  result.every *= static_cast<long>(k);
  result.t = thinned(page.t, k, false);
  result.q = thinned(page.q, k);
  result.v = thinned(page.v, k);
  for (PageChart& chart : result.charts)
    for (PageCurve& curve : chart.curves) curve.values = thinned(curve.values, k, curve.is_error);
  return result;
}

constexpr int most_tics = 7;

OrderedJson json_of(const AxisRange& range, const Tics& tics) {
  OrderedJson list = OrderedJson::array();
  for (const Tic& tic : tics.tics)
    if (!tic.text.empty()) list.push_back({tic.at, tic.text});
  return {{"range", {range.from, range.to}}, {"factor", tics.factor}, {"tics", list}};
}

OrderedJson json_of(const PageChart& chart, std::size_t first_column) {
  constexpr double room = 1 / double{25};
  std::vector<double> all;
  OrderedJson curves = OrderedJson::array();
  for (const PageCurve& curve : chart.curves) {
    all.insert(all.end(), curve.values.begin(), curve.values.end());
    curves.push_back({{"name", curve.name}, {"column", first_column++}});
    if (curve.number > 0) curves.back()["number"] = curve.number;
    if (!curve.label.empty()) curves.back()["label"] = curve.label;
  }
  AxisRange range = widened(range_of(all), room);
  if (chart.round_off) range = ended_at_round_off(range, *chart.round_off);
  OrderedJson json = json_of(range, tics_of(range, chart.scale, most_tics));
  json["title"] = chart.title;
  json["symbol"] = chart.symbol;
  json["decimal"] = chart.scale == AxisScale::decimal;
  if (chart.round_off) json["round_off"] = *chart.round_off;
  json["curves"] = curves;
  return json;
}

/// Of all that has mass, at each time.
OrderedJson velocities(const MovingPage& page) {
  OrderedJson list = OrderedJson::array();
  for (const std::vector<double>& v : page.v) {
    OrderedJson& row = list.emplace_back(OrderedJson::array());
    for (std::size_t i = 0; i < page.sketch.places.size(); ++i) {
      if (!page.sketch.places[i].has_mass) continue;
      const std::array<double, 3> of_place = page.sketch.velocity(i, v);
      OrderedJson& parts = row.emplace_back(OrderedJson::array());
      for (int j = 0; j < page.sketch.dimension; ++j)
        parts.push_back(any_number(as_drawn(of_place[static_cast<std::size_t>(j)])));
    }
  }
  return list;
}

/// The charts, and rows of t, q and the values of all curves, where each chart finds its own.
void add_data(OrderedJson& data, const MovingPage& page) {
  OrderedJson charts = OrderedJson::array(), rows = OrderedJson::array();
  std::size_t column = 1 + page.q.front().size();
  for (const PageChart& chart : page.charts) {
    charts.push_back(json_of(chart, column));
    column += chart.curves.size();
  }
  for (std::size_t i = 0; i < page.t.size(); ++i) {
    OrderedJson row = OrderedJson::array({any_number(page.t[i])});
    for (const double x : page.q[i]) row.push_back(any_number(x));
    for (const PageChart& chart : page.charts)
      for (const PageCurve& curve : chart.curves) row.push_back(any_number(curve.values[i]));
    rows.push_back(std::move(row));
  }
  const AxisRange time = range_of(page.t);
  data["time"] = json_of(time, tics_of(time, AxisScale::linear, most_tics));
  data["charts"] = charts;
  data["samples"] = rows;
  data["velocities"] = velocities(page);
}

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

/// What is seen of the run, and whether it came to its end.
std::string account_of(const MovingPage& page) {
  std::string text = page.every == 1
                         ? fmt::format("Every state of {} step{}.", grouped(page.steps), page.steps == 1 ? "" : "s")
                         : fmt::format(
                               "Every {} of {} steps, and the last; each error is the greatest since the "
                               "state shown before it.",
                               ordinal(page.every), grouped(page.steps));
  if (page.last_step < page.steps)
    text += fmt::format(" The run ended early: what is shown ends at t = {:.6g}.", page.t.back());
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

/// A scene that would fill the page is cut.
std::string cut(const std::string& text) {
  constexpr std::size_t most = moving_page_bytes / 10;
  if (text.size() <= most) return text;
  const std::size_t end = text.rfind('\n', most) + 1, rest = text.size() - end;
  return text.substr(0, end) + "# … and " + grouped(static_cast<long>(rest)) + " bytes more\n";
}

}  // namespace

std::string moving_page(const MovingPage& page) {
  const PageParts& parts = page_parts();
  if (parts.dygraphs.empty())
    throw InputError("this build has no dygraphs, which draws the curves of a page; write .svg or .png instead");
  const OrderedJson drawn = json_of(page.sketch, page.colours);
  OrderedJson colours = OrderedJson::array();
  for (const std::string_view colour : curve_colours) colours.push_back(colour);
  std::map<std::string, std::string, std::less<>> words{{"title", html(page.title)},
                                                        {"name", html(page.name)},
                                                        {"method", html(page.method)},
                                                        {"precision", html(page.precision)},
                                                        {"step", html(page.step)},
                                                        {"until", html(page.until)},
                                                        {"program", html(std::string("hbvm ") + version())},
                                                        {"command", html(page.command)},
                                                        {"scene", html(cut(page.scene))},
                                                        {"style", parts.dygraphs_style + parts.style},
                                                        {"dygraphs", parts.dygraphs},
                                                        {"script", parts.script}};
  // As many times as there is room for.
  for (std::size_t k = 1;; ++k) {
    const MovingPage shown = thinned(page, k);
    OrderedJson data{{"colours", colours},
                     {"every", shown.every},
                     {"steps", shown.steps},
                     {"last_step", shown.last_step},
                     {"sketch", drawn}};
    add_data(data, shown);
    words["account"] = html(account_of(shown));
    words["data"] = within_script(dumped(data, -1));
    std::string text = filled(parts.html, words);
    if (text.size() < moving_page_bytes) return text;
    if (shown.t.size() <= 2)
      throw Error(fmt::format("'{}' has {} coordinates, too many for a page of less than {} bytes: use --plot FILE.svg",
                              page.name, shown.q.front().size(), moving_page_bytes));
  }
}

}  // namespace hbvm::core
