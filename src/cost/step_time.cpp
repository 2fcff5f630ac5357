#include "cost/step_time.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "long_work/json.hpp"

namespace hbvm::core {
namespace {

/// Seen beside one another: of each kind of method and of few and many stages.
bool shows_a_step(const Method& method) {
  const std::string text = method.text();
  return text == "rattle" || text == "hbvm:2,2" || text == "hbvm:4,4" || text == "hbvm:8,8" || text == "hbvm:16,16";
}

const StepTime* time_of(const std::vector<StepTime>& times, const Method& method, const char* precision) {
  for (const StepTime& t : times)
    if (t.failure.empty() && t.cell.method->key() == method.key() && t.cell.precision.name() == precision) return &t;
  return nullptr;
}

}  // namespace

std::vector<CostCell> step_time_cells(const CostStudy& study, const MotionNature& nature) {
  std::vector<CostCell> cells;
  for (const MethodPtr& method : study.methods) {
    if (!shows_a_step(*method)) continue;
    for (const std::string_view name :
         {"double", "quad", "mpfr:20", "mpfr:34", "mpfr:50", "mpfr:100", "mpfr:200", "mpfr:500", "mpfr:1000"})
      if (has_quad || name != "quad")
        cells.push_back({method, Precision::parse(name), std::max(1L, std::lround(usual_steps(study, nature)))});
  }
  return cells;
}

std::string measure_step_time(const CostStudy& study, const CostCell& cell) {
  constexpr int repetitions = 5, most_halvings = 8;
  constexpr long most = 400;
  constexpr double enough = double{1} / 20;
  CostCell tried = cell;
  CostSample sample = sample_cost(study.scene, study.until, tried, most, enough);
  // Not every method can make a step of this length.
  for (int n = 0; n < most_halvings && !sample.failure.empty(); ++n) {
    tried.steps *= 2;
    sample = sample_cost(study.scene, study.until, tried, most, enough);
  }
  std::vector<double> seconds{sample.seconds};
  for (int n = 1; n < repetitions && sample.failure.empty(); ++n) {
    sample = sample_cost(study.scene, study.until, tried, most, enough);
    seconds.push_back(sample.seconds);
  }
  if (!sample.failure.empty()) return dumped({{"failure", sample.failure}}, -1);
  return dumped({{"failure", ""},
                 {"steps", tried.steps},
                 {"seconds", *std::min_element(seconds.begin(), seconds.end())},
                 {"operations", sample.operations}},
                -1);
}

StepTime read_step_time(const CostCell& cell, const std::string& text) {
  return read_json(text, "the time of a step", [&](const OrderedJson& json) {
    StepTime time{cell, json.at("failure")};
    if (!time.failure.empty()) return time;
    time.cell.steps = json.at("steps");
    time.seconds = json.at("seconds");
    time.operations = json.at("operations");
    return time;
  });
}

Table step_time_table(const CostStudy& study, const std::vector<StepTime>& times) {
  Table table;
  table.caption = fmt::format("The time of a step: {}", study.scene.name);
  table.columns = {"method", "precision", "step", "seconds", "operations"};
  table.groups.emplace_back();
  for (const StepTime& t : times)
    if (t.failure.empty())
      table.groups.back().rows.push_back({t.cell.method->text(), t.cell.precision.name(),
                                          step_text(study.until, t.cell.steps), fmt::format("{:.3g}", t.seconds),
                                          fmt::format("{:.0f}", t.operations)});
  return table;
}

Figure step_time_figure(const CostStudy& study, const std::vector<StepTime>& times) {
  Figure figure;
  figure.name = "step_time";
  figure.caption = plain(study.scene.name) + ": what a step costs in each precision";
  figure.footnote =
      cost_footnote(study) +
      "; steps of a quarter of the radius of convergence, or half as long until the method can make them, to round-off";
  Panel digits;
  digits.title = "Lines: MPFR; circles: double and quad";
  digits.x = {"working digits", AxisScale::decimal};
  digits.y = {"processor time of a step / s", AxisScale::decimal};
  digits.labels_beside = true;
  Panel quad;
  quad.title = "binary128 against MPFR with as many digits";
  quad.y = {"quad over mpfr:34, % of the time"};
  double most = 0;
  for (const MethodPtr& method : study.methods) {
    if (!shows_a_step(*method)) continue;
    Curve curve{plain(method->title()), {}, true};
    for (const StepTime& t : times) {
      if (!t.failure.empty() || t.cell.method->key() != method->key() || !(t.seconds > 0)) continue;
      const PlotPoint at{std::log10(static_cast<double>(t.cell.precision.digits())), std::log10(t.seconds)};
      if (t.cell.precision.kind() == Precision::Kind::mpfr)
        curve.points.push_back(at);
      else
        digits.marks.push_back({at, Mark::Look::start, ""});
    }
    if (!curve.points.empty()) digits.curves.push_back(std::move(curve));
    const StepTime *const in_quad = time_of(times, *method, "quad"), *const in_mpfr =
                                                                         time_of(times, *method, "mpfr:34");
    if (!in_quad || !in_mpfr) continue;
    const auto x = static_cast<double>(quad.x.names.size());
    const double percent = 100 * in_quad->seconds / in_mpfr->seconds;
    quad.x.names.push_back(plain(method->title()));
    quad.bars.push_back({x, 0, percent, quad.bars.size()});
    most = std::max(most, percent);
    quad.labels.push_back({{x - double{3} / 10, percent}, fmt::format("{:.0f} %", percent)});
  }
  // Room for the first marks, and for the words above the bars.
  constexpr double room = double{23} / 20, words = double{1} / 30;
  if (!digits.curves.empty())
    digits.lines.push_back({{{std::log10(Precision::parse("double").digits() / room), digits.curves[0].points[0][1]}}});
  for (Label& label : quad.labels) label.at[1] += words * most;
  const double all = static_cast<double>(quad.bars.size()) - double{1} / 2;
  quad.lines = {{{{-double{1} / 2, 100}, {all, 100}}, Polyline::Look::dashed}, {{{0, room * most}}}};
  figure.panels.push_back(std::move(digits));
  if (!quad.bars.empty()) figure.panels.push_back(std::move(quad));
  return figure;
}

}  // namespace hbvm::core
