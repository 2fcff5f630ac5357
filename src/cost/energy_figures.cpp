#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cost/energy_cost.hpp"
#include "step/hbvm_method.hpp"
#include "step/registry.hpp"

namespace hbvm::core {
namespace {

Panel energy_panel(const std::string& title) {
  Panel panel;
  panel.title = title;
  panel.y = {"greatest error of H / size of its terms", AxisScale::decimal};
  panel.labels_beside = true;
  return panel;
}

/// A curve for each s, of what `value` says of a run and the one with k = s.
void add_stages(Panel& panel, const std::vector<EnergyCost>& runs, const char* precision,
                double (*value)(const EnergyCost& run, const EnergyCost& with_k_equal_s)) {
  const EnergyCost* least = nullptr;
  for (const EnergyCost& run : runs) {
    if (run.cell.precision.name() != precision || !run.failure.empty()) continue;
    const HbvmName& name = as_hbvm(*run.cell.method)->name();
    if (name.k == name.s) {
      least = &run;
      panel.curves.push_back({fmt::format("s = {}", name.s), {}, true});
    }
    if (!least || as_hbvm(*least->cell.method)->name().s != name.s) continue;
    panel.curves.back().points.push_back({static_cast<double>(name.k) / name.s, value(run, *least)});
  }
}

/// With its k as chosen.
std::string title_of(const EnergyCost& run) {
  const HbvmMethod* const hbvm = as_hbvm(*run.cell.method);
  return hbvm && hbvm->name().is_auto() ? parse_method(run.method)->title() + ", auto" : run.cell.method->title();
}

}  // namespace

Table energy_table(const CostStudy& study, const Expression& until, const std::vector<EnergyCost>& runs) {
  Table table;
  table.caption = fmt::format("Energy and time: {} to t = {}", study.scene.name, until.text());
  table.columns = {"precision", "method", "made_by", "steps", "step", "seconds", "log10_error_H", "log10_round_off"};
  table.groups.emplace_back();
  for (const EnergyCost& run : runs)
    if (run.failure.empty())
      table.groups.back().rows.push_back({run.cell.precision.name(), run.cell.method->text(), run.method,
                                          std::to_string(run.cell.steps), step_text(until, run.cell.steps),
                                          fmt::format("{:.3g}", run.seconds), fmt::format("{:.2f}", run.log10_error()),
                                          fmt::format("{:.2f}", run.log10_round_off)});
  return table;
}

Figure energy_figure(const CostStudy& study, const Expression& until, const std::vector<EnergyCost>& runs) {
  Figure figure;
  figure.name = "energy";
  figure.caption =
      fmt::format("{} to t = {}, in double: the error of the energy", plain(study.scene.name), plain(until.text()));
  figure.footnote = cost_footnote(study);
  Panel growth = energy_panel("At equal cost, against time of integration");
  growth.x = {"t", AxisScale::decimal};
  for (const EnergyCost* const run : at_equal_cost(runs))
    growth.curves.push_back({plain(title_of(*run)) + fmt::format(", {:.2g} s", run->seconds), run->growth});
  Panel cost = energy_panel("At the end, against what the run costs");
  cost.x = {"processor time / s", AxisScale::decimal};
  for (const EnergyCost& run : runs) {
    if (!run.failure.empty() || !(run.seconds > 0)) continue;
    const std::string label = plain(run.cell.method->title());
    if (cost.curves.empty() || cost.curves.back().label != label) cost.curves.push_back({label, {}, true});
    cost.curves.back().points.push_back({std::log10(run.seconds), run.log10_error()});
  }
  figure.panels = {growth, cost};
  return figure;
}

Figure conserving_figure(const CostStudy& study, const std::vector<EnergyCost>& runs) {
  Figure figure;
  figure.name = "conserving";
  figure.caption = fmt::format("{} to t = {}: what conserving the energy costs, and what it buys",
                               plain(study.scene.name), plain(study.until.text()));
  figure.footnote = cost_footnote(study) + "; steps of a quarter of the radius of convergence";
  const auto ratio = [](const EnergyCost& run, const EnergyCost& least) { return run.seconds / least.seconds; };
  for (const char* const precision : {"double", "mpfr:40"}) {
    Panel& panel = figure.panels.emplace_back();
    panel.title = fmt::format("Time of HBVM(k,s) over that of HBVM(s,s), {}", precision);
    panel.x = {"k / s"};
    panel.y = {"ratio of processor times"};
    add_stages(panel, runs, precision, ratio);
  }
  Panel panel = energy_panel("Error of the energy, 40 digits");
  panel.labels_beside = false;
  panel.x = {"k / s"};
  // What is round-off alone is no curve that fills the panel.
  constexpr double above_round_off = -37;
  panel.lines.push_back({{{1, above_round_off}}});
  add_stages(panel, runs, "mpfr:40", [](const EnergyCost& run, const EnergyCost&) { return run.log10_error(); });
  figure.panels.push_back(std::move(panel));
  return figure;
}

}  // namespace hbvm::core
