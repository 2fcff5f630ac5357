#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "cost/cost_report.hpp"
#include "cost/measuring_system.hpp"
#include "cost/pareto.hpp"
#include "step/hbvm_method.hpp"

namespace hbvm::core {
namespace {

/// What of a measurement is drawn: log10 of an error.
using ErrorOf = std::function<double(const CostMeasurement&)>;

/// Findings that came to their end and are drawn, with where they stand: digits to the right, log10 of seconds up.
struct Drawn {
  const CostFinding* finding;
  PlotPoint at;
};

std::vector<Drawn> drawn(const CostStudy& study, const CostOutcome& outcome, const ErrorOf& error) {
  std::vector<Drawn> result;
  const std::vector<double> seconds = corrected_seconds(outcome.findings);
  for (std::size_t i = 0; i < outcome.findings.size(); ++i) {
    const CostFinding& f = outcome.findings[i];
    if (!f.measured.failure.empty() || !(seconds[i] > 0)) continue;
    const double digits = -error(f.measured);
    // Errors as great as what they are of say nothing of an order.
    if (std::isfinite(digits) && digits > 0 && digits <= study.most_digits + 8)
      result.push_back({&f, {digits, std::log10(seconds[i])}});
  }
  return result;
}

std::vector<PlotPoint> front_of(const std::vector<Drawn>& all) {
  std::vector<CostPoint> points;
  for (const Drawn& d : all) points.push_back({d.at[1], -d.at[0]});
  std::vector<PlotPoint> front;
  for (const std::size_t i : pareto_front(points)) front.push_back(all[i].at);
  return front;
}

/// How many times longer than the front a point takes: the time of the front at the same digits.
double above_front(const std::vector<PlotPoint>& front, const PlotPoint& at) {
  for (const PlotPoint& f : front)
    if (f[0] >= at[0]) return at[1] - f[1];
  return 0;
}

Panel work_panel(const std::string& title) {
  Panel panel;
  panel.title = title;
  panel.x = {"relative error", AxisScale::falling};
  panel.y = {"processor time / s", AxisScale::decimal};
  panel.labels_beside = true;
  return panel;
}

/// Of those that divide their steps, whatever digits they are asked for, one curve is the front.
std::string curve_key(const Method& method) { return method.digits() ? family_of(method) : method.key(); }

/// A curve a method, of its steps that are the best for something. Of each family the method that is nearest to the
/// front of all is drawn, then others as near as may be.
void add_methods(Panel& panel, const std::vector<Drawn>& all) {
  constexpr std::size_t most = 9;
  const std::vector<PlotPoint> front = front_of(all);
  struct Candidate {
    const Method* method;
    std::vector<Drawn> points;
    double above;
  };
  std::vector<Candidate> candidates;
  for (const Drawn& d : all) {
    const Method* const method = d.finding->cell.method.get();
    auto place = std::find_if(candidates.begin(), candidates.end(),
                              [&](const Candidate& c) { return curve_key(*c.method) == curve_key(*method); });
    if (place == candidates.end())
      place = candidates.insert(place, {method, {}, std::numeric_limits<double>::infinity()});
    place->points.push_back(d);
    place->above = std::min(place->above, above_front(front, d.at));
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.above < b.above; });
  std::vector<Candidate> chosen, others;
  for (Candidate& c : candidates) {
    const auto same = [&](const Candidate& other) { return family_of(*other.method) == family_of(*c.method); };
    (std::none_of(chosen.begin(), chosen.end(), same) ? chosen : others).push_back(std::move(c));
  }
  for (Candidate& c : others)
    if (chosen.size() < most) chosen.push_back(std::move(c));
  if (chosen.size() > most) chosen.resize(most);
  std::stable_sort(chosen.begin(), chosen.end(),
                   [](const Candidate& a, const Candidate& b) { return a.method->order() < b.method->order(); });
  for (const Candidate& c : chosen) {
    const bool divides = c.method->digits().has_value();
    std::string label = divides ? family_of(*c.method) : c.method->title();
    const std::string order = fmt::format(", order {}", c.method->order());
    if (c.method->order() > 0 && !divides && !label.ends_with(order)) label += order;
    panel.curves.push_back({plain(label), front_of(c.points), true});
  }
  panel.lines.push_back({front, Polyline::Look::front});
}

std::string title_of(const Precision& precision) {
  return precision.kind() == Precision::Kind::mpfr ? fmt::format("{} digits", precision.digits()) : precision.name();
}

/// The front of each group of findings, named by a function.
void add_fronts(Panel& panel, const std::vector<Drawn>& all,
                const std::function<std::string(const CostFinding&)>& name) {
  std::vector<std::pair<std::string, std::vector<Drawn>>> groups;
  for (const Drawn& d : all) {
    const std::string key = name(*d.finding);
    auto group = std::find_if(groups.begin(), groups.end(), [&](const auto& g) { return g.first == key; });
    if (group == groups.end()) group = groups.insert(group, {key, {}});
    group->second.push_back(d);
  }
  for (const auto& [key, members] : groups) {
    Curve curve{plain(key), front_of(members), true};
    if (!curve.points.empty()) panel.curves.push_back(std::move(curve));
  }
}

}  // namespace

std::string family_of(const Method& method) {
  if (const HbvmMethod* const hbvm = as_hbvm(method)) {
    const HbvmName& name = hbvm->name();
    return name.is_auto() ? "HBVM(auto,s)" : name.k == name.s ? "HBVM(s,s)" : "HBVM(k,s)";
  }
  const std::string title = method.title();
  // HBVM that ends its steps otherwise is another.
  if (title.starts_with("HBVM")) return "HBVM" + title.substr(title.find(')') + 1);
  return title.substr(0, title.find_first_of(":(,"));
}

std::string cost_footnote(const CostStudy& study) {
  std::string text = fmt::format("hbvm cost {} --until {} --quantity {}", study.scene.name, study.until.text(),
                                 name_of(study.quantity));
  for (const auto& [key, value] : measuring_system())
    if (key == "machine") text += "; " + value;
  return text;
}

Figure work_precision_figure(const CostStudy& study, const CostOutcome& outcome) {
  const std::vector<Drawn> all =
      drawn(study, outcome, [&](const CostMeasurement& m) { return m.errors.of(study.quantity); });
  Figure figure;
  figure.name = "work_precision";
  figure.caption =
      fmt::format("{} to t = {}: time against the error of {}", plain(study.scene.name), plain(study.until.text()),
                  study.quantity == CostQuantity::all ? "q, p and λ" : name_of(study.quantity));
  figure.footnote = cost_footnote(study) + fmt::format("; reference of {} digits", outcome.reference.digits);
  figure.panels.push_back(work_panel("The best of each precision"));
  add_fronts(figure.panels.back(), all, [](const CostFinding& f) { return title_of(f.cell.precision); });
  std::vector<Precision> precisions;
  for (const Drawn& d : all)
    if (precisions.empty() || !(precisions.back() == d.finding->cell.precision))
      precisions.push_back(d.finding->cell.precision);
  for (const Precision& precision : precisions) {
    std::vector<Drawn> those;
    for (const Drawn& d : all)
      if (d.finding->cell.precision == precision) those.push_back(d);
    figure.panels.push_back(work_panel(title_of(precision)));
    add_methods(figure.panels.back(), those);
  }
  return figure;
}

Figure digits_figure(const CostStudy& study, const CostOutcome& outcome) {
  Figure figure;
  figure.name = "digits";
  figure.caption = fmt::format("{} to t = {}: what digits cost", plain(study.scene.name), plain(study.until.text()));
  figure.footnote = cost_footnote(study) + fmt::format("; reference of {} digits", outcome.reference.digits);
  const auto panel_of = [](const std::string& title) {
    Panel panel = work_panel(title);
    panel.x = {"right digits", AxisScale::linear};
    return panel;
  };
  const std::vector<Drawn> all =
      drawn(study, outcome, [&](const CostMeasurement& m) { return m.errors.of(study.quantity); });
  figure.panels.push_back(panel_of("The best of each family, in any precision"));
  add_fronts(figure.panels.back(), all, [](const CostFinding& f) { return family_of(*f.cell.method); });
  // The same runs, judged by what was propagated.
  Panel& panel = figure.panels.emplace_back(panel_of("HBVM(s,s): what is propagated, and the output state"));
  const auto gauss = [&](const std::string& label, const ErrorOf& error) {
    std::vector<Drawn> those = drawn(study, outcome, error);
    std::erase_if(those, [](const Drawn& d) { return family_of(*d.finding->cell.method) != "HBVM(s,s)"; });
    Curve curve{label, front_of(those), true};
    if (!curve.points.empty()) panel.curves.push_back(std::move(curve));
  };
  gauss("q", [](const CostMeasurement& m) { return m.errors.q; });
  gauss("p, output", [](const CostMeasurement& m) { return m.errors.p; });
  gauss("λ, output", [](const CostMeasurement& m) { return m.errors.lambda; });
  gauss("p, propagated", [](const CostMeasurement& m) { return m.raw.p; });
  gauss("λ, propagated", [](const CostMeasurement& m) { return m.raw.lambda; });
  if (panel.curves.empty()) figure.panels.pop_back();
  return figure;
}

}  // namespace hbvm::core
