#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include "door/door.hpp"
#include "door/run_of.hpp"
#include "hbvm/error.hpp"
#include "hbvm/run.hpp"
#include "hbvm/study.hpp"
#include "hbvm/table.hpp"
#include "long_work/json.hpp"
#include "scene/set_number.hpp"
#include "step/registry.hpp"
#include "study/convergence_figure.hpp"

namespace hbvm {
namespace {

core::ConvergenceWork work_of(const ConvergenceRequest& asked) {
  if (asked.methods.empty()) throw InputError("no method is named");
  if (asked.precisions.empty()) throw InputError("no precision is named");
  const std::size_t curves = asked.methods.size() * asked.precisions.size();
  if (curves > curve_colours.size())
    throw InputError(
        fmt::format("{} methods in {} precisions are more than the {} curves that a picture can tell apart",
                    asked.methods.size(), asked.precisions.size(), curve_colours.size()));
  const core::Constants constants = core::scene_of(asked.scene).constants;
  std::vector<core::Expression> steps = core::halved_steps(asked.steps, constants);
  const Number until = asked.until.value_or(Number(core::time_of_sixteen(steps.front(), constants).text()));
  const core::RunRequest request =
      core::request_of({.scene = asked.scene, .method = asked.methods.front(), .step = until, .until = until}, {});
  core::ConvergenceWork work{request, core::named_methods(asked.methods), {}, std::move(steps)};
  for (const std::string& name : asked.precisions) work.precisions.push_back(core::Precision::parse(name));
  work.propagated = asked.propagated;
  work.progress = asked.progress;
  return work;
}

std::string command_of(const ConvergenceRequest& asked, const core::ConvergenceWork& work) {
  std::string text =
      "hbvm convergence " + work.request.scene.name + core::settings_in_command(work.request.scene) + " --methods";
  for (const core::NamedMethod& method : work.methods) text += " " + method.name;
  text += " --steps '" + asked.steps + "' --until '" + work.request.until.text() + "' --precision";
  for (const core::Precision& precision : work.precisions) text += " " + precision.name();
  return text + (work.propagated ? " --propagated" : "");
}

std::optional<MeasuredRate> rate_of(const std::optional<core::Rate>& rate) {
  if (!rate) return std::nullopt;
  return MeasuredRate{rate->value, rate->uncertainty};
}

MethodOrders orders_of(const core::MeasuredConvergence& one) {
  MethodOrders orders{.method = one.method,
                      .resolved = one.resolved,
                      .precision = one.precision,
                      .q = rate_of(one.rates[0]),
                      .p = rate_of(one.rates[1]),
                      .lambda = rate_of(one.rates[2]),
                      .points = {},
                      .failure = one.failure};
  for (const core::ConvergenceStep& step : one.steps)
    orders.points.push_back({step.step, step.errors[0], step.errors[1], step.errors[2]});
  return orders;
}

std::string text_of(const std::optional<MeasuredRate>& rate) {
  return rate ? fmt::format("{:.2f} +- {:.2f}", rate->value, rate->uncertainty) : "-";
}

bool has_lambda(const ConvergenceStudy& convergence) {
  for (const MethodOrders& one : convergence.methods)
    if (!one.points.empty() && !one.points.front().lambda.empty()) return true;
  return false;
}

/// A step as one writes it: 1/256, or else a decimal number.
std::string short_step(const std::string& decimal) {
  const double step = std::strtod(decimal.c_str(), nullptr), parts = std::round(1 / step);
  constexpr double most = 1'000'000'000;
  if (parts > 1 && parts < most && std::abs(1 / step - parts) * most <= parts)
    return fmt::format("1/{}", std::lround(parts));
  return fmt::format("{:.6g}", step);
}

/// A group a method: errors at each step, and in its last row what they tend to.
Table errors_of(const ConvergenceStudy& convergence, bool constrained) {
  Table table;
  table.columns = {"step", "error of q", "error of p"};
  if (constrained) table.columns.emplace_back("error of lambda");
  for (const MethodOrders& one : convergence.methods) {
    const std::string meant = one.resolved == one.method ? "" : " (" + one.resolved + ")";
    Table::Group& group = table.groups.emplace_back();
    group.heading = one.method + meant + ", " + one.precision;
    const auto add = [&](const std::string& first, const std::string& q, const std::string& p,
                         const std::string& lambda) {
      std::vector<std::string>& row = group.rows.emplace_back(std::vector<std::string>{first, q, p});
      if (constrained) row.push_back(lambda);
    };
    for (const MethodOrders::Point& point : one.points) add(short_step(point.step), point.q, point.p, point.lambda);
    add("order", text_of(one.q), text_of(one.p), text_of(one.lambda));
  }
  return table;
}

/// A row a method.
Table rates_of(const ConvergenceStudy& convergence, bool constrained) {
  Table table;
  table.columns = {"method", "precision", "order of q", "order of p"};
  if (constrained) table.columns.emplace_back("order of lambda");
  Table::Group& group = table.groups.emplace_back(Table::Group{.heading = "orders of all", .keys = {}, .rows = {}});
  for (const MethodOrders& one : convergence.methods) {
    group.rows.push_back({one.method, one.precision, text_of(one.q), text_of(one.p)});
    if (constrained) group.rows.back().push_back(text_of(one.lambda));
  }
  return table;
}

}  // namespace

ConvergenceStudy convergence(const ConvergenceRequest& door) {
  const core::Admitted admitted(door.stop);
  const core::ConvergenceWork work = work_of(door);
  const std::vector<core::MeasuredConvergence> measured = core::measure_convergence(work);
  ConvergenceStudy result;
  result.scene = work.request.scene.name;
  result.title = work.request.scene.title;
  result.until = work.request.until.text();
  result.propagated = work.propagated;
  result.command = command_of(door, work);
  for (const core::MeasuredConvergence& one : measured) result.methods.push_back(orders_of(one));
  if (door.picture) result.figure = core::convergence_figure(work, measured, result.command);
  return result;
}

std::string to_text(const ConvergenceStudy& convergence) {
  const bool constrained = has_lambda(convergence);
  const char* const parts = !constrained             ? ""
                            : convergence.propagated ? "; p and lambda propagated"
                                                     : "; p and lambda of the output state";
  std::string text =
      fmt::format("{}: {} at t = {}{}\n\n", convergence.scene, convergence.title, convergence.until, parts);
  text += to_text(errors_of(convergence, constrained));
  if (convergence.methods.size() > 1) text += to_text(rates_of(convergence, constrained));
  for (const MethodOrders& one : convergence.methods)
    if (!one.failure.empty()) text += one.method + ", " + one.precision + ", " + one.failure + "\n";
  return text;
}

std::string to_json(const ConvergenceStudy& convergence) {
  core::OrderedJson methods = core::OrderedJson::array();
  for (const MethodOrders& one : convergence.methods) {
    core::OrderedJson orders, points = core::OrderedJson::array();
    const auto add = [&](const char* name, const std::optional<MeasuredRate>& rate) {
      if (rate)
        orders[name] = {{"rate", rate->value}, {"uncertainty", rate->uncertainty}};
      else
        orders[name] = nullptr;
    };
    add("q", one.q);
    add("p", one.p);
    if (has_lambda(convergence)) add("lambda", one.lambda);
    for (const MethodOrders::Point& point : one.points) {
      core::OrderedJson error{{"q", point.q}, {"p", point.p}};
      if (!point.lambda.empty()) error["lambda"] = point.lambda;
      points.push_back({{"step", point.step}, {"error", error}});
    }
    core::OrderedJson json{{"method", one.method},
                           {"resolved", one.resolved},
                           {"precision", one.precision},
                           {"orders", orders},
                           {"points", points}};
    if (!one.failure.empty()) json["failure"] = one.failure;
    methods.push_back(std::move(json));
  }
  return core::dumped({{"scene", convergence.scene},
                       {"until", convergence.until},
                       {"propagated", convergence.propagated},
                       {"methods", methods},
                       {"command", convergence.command}},
                      2);
}

}  // namespace hbvm
