#include <fmt/format.h>

#include <cmath>

#include "cost/planner.hpp"
#include "hbvm/version.hpp"
#include "long_work/json.hpp"
#include "scene/set_number.hpp"

namespace hbvm::core {
namespace {

using Json = OrderedJson;

/// 10^x as a number where double has one, else as text.
Json error_number(double log10) {
  const double error = std::pow(10, log10);
  return error > 0 && std::isfinite(error) ? Json(error) : Json(fmt::format("1e{:.2f}", log10));
}

Json setting_json(const PlannedSetting& s) {
  return {{"method", s.method->text()}, {"step", s.step}, {"precision", s.precision.name()}};
}

Json predicted_json(const PlannedSetting& s) {
  return {{"seconds", s.predicted_seconds},
          {"error", error_number(s.predicted_error)},
          {"operations_a_step", s.operations},
          {"nanoseconds_an_operation", s.nanoseconds}};
}

Json measured_json(const PlannedSetting& s) {
  if (!s.seconds) return nullptr;
  return {{"seconds", *s.seconds}, {"error", error_number(*s.error)}};
}

std::string shell_word(const std::string& text) {
  return text.find_first_of(" *()'") == std::string::npos ? text : "'" + text + "'";
}

std::string run_command(const PlanRequest& request, const PlannedSetting& s) {
  return fmt::format("hbvm run {} --method {} --step {} --until {} --precision {}",
                     shell_word(request.scene.name) + settings_in_command(request.scene), s.method->text(),
                     shell_word(s.step), shell_word(request.until.text()), s.precision.name());
}

std::string error_text(double log10) {
  const double exponent = std::floor(log10);
  return fmt::format("{:.1f}e{:+03d}", std::pow(10, log10 - exponent), static_cast<int>(exponent));
}

std::string row(const PlannedSetting& s) {
  return fmt::format("{:<18} {:<10} {:<14} {:>11.3g} {:>11} {:>11} {:>11}\n", s.method->text(), s.precision.name(),
                     s.step, s.predicted_seconds, error_text(s.predicted_error),
                     s.seconds ? fmt::format("{:.3g}", *s.seconds) : "", s.error ? error_text(*s.error) : "");
}

}  // namespace

std::string to_json(const PlanRequest& request, const Plan& plan, const std::string& command) {
  Json json{{"digits", request.digits},
            {"pick", setting_json(plan.pick)},
            {"predicted", predicted_json(plan.pick)},
            {"measured", measured_json(plan.pick)}};
  json["runners_up"] = Json::array();
  for (const PlannedSetting& s : plan.runners_up) {
    Json entry = setting_json(s);
    entry["predicted"] = predicted_json(s);
    entry["measured"] = measured_json(s);
    json["runners_up"].push_back(entry);
  }
  json["run"] = run_command(request, plan.pick);
  json["scene"] = request.scene.name;
  json["until"] = request.until.text();
  json["quantity"] = name_of(request.quantity);
  json["digits_lost"] = plan.nature.digits_lost;
  json["reference"] = {{"digits", plan.reference.digits}, {"source", plan.reference.source}};
  json["runs"] = plan.runs;
  json["version"] = version();
  json["command"] = command;
  return dumped(json, 1);
}

std::string to_text(const PlanRequest& request, const Plan& plan) {
  std::string text = fmt::format("{} right digits of {} of {} at t = {}\n\n", request.digits, name_of(request.quantity),
                                 request.scene.name, request.until.text());
  text += fmt::format("{:<18} {:<10} {:<14} {:>23} {:>23}\n", "", "", "", "predicted", "measured");
  text += fmt::format("{:<18} {:<10} {:<14} {:>11} {:>11} {:>11} {:>11}\n", "method", "precision", "step", "seconds",
                      "error", "seconds", "error");
  text += row(plan.pick);
  for (const PlannedSetting& s : plan.runners_up) text += row(s);
  text += fmt::format(
      "\nThe first is the pick; {} runs to the end were made to find it. Of the processor: {} steps of {:.3g} "
      "operations of {:.3g} ns.\nThe motion magnifies errors by 10^{:.1f}; compared with {} digits ({}).\n\n  {}\n",
      plan.runs, plan.pick.steps, plan.pick.operations, plan.pick.nanoseconds, plan.nature.digits_lost,
      plan.reference.digits, plan.reference.source, run_command(request, plan.pick));
  return text;
}

}  // namespace hbvm::core
