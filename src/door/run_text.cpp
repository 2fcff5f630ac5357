#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "door/horizon_text.hpp"
#include "hbvm/run.hpp"
#include "hbvm/table.hpp"
#include "run/shadow.hpp"
#include "scalar/text.hpp"

namespace hbvm {
namespace {

using Texts = std::vector<std::string>;

/// Of a state whose digits nobody checked.
constexpr int unassessed_digits = 6;
/// Of a vector, unless all of the state is asked for.
constexpr std::size_t most_rows = 24;

std::string short_text(const std::string& number) {
  constexpr int digits = 3;
  return core::to_scientific(number, digits);
}

bool is_assessed(const Run& run) { return run.error && run.error->failure.empty(); }

/// What the error was found by.
std::string compared_with(const ErrorEstimate& error) {
  return error.method.empty() ? "the " + error.reference
                              : fmt::format("{}, {}, {}", error.method, error.precision, error.reference);
}

std::string verdict_of(const Run& run) {
  Texts parts;
  if (is_assessed(run)) {
    parts.push_back(fmt::format("q right to {}, p to {}{}", run.error->q, run.error->p,
                                run.error->lambda.empty() ? "" : ", lambda to " + run.error->lambda));
  } else {
    parts.emplace_back(run.error ? "digits unknown" : "digits not assessed (--error)");
  }
  parts.push_back(fmt::format("{} off by {} of its terms{}", run.work.empty() ? "H" : "H - W", run.health.worst_e_H,
                              run.lambda.empty() ? "" : ", constraints by " + short_text(run.e_g)));
  Texts warnings;
  for (const Warning& warning : run.health.warnings) warnings.push_back(warning.name);
  parts.push_back(warnings.empty() ? "no warning"
                                   : fmt::format("{} warning{}: {}", warnings.size(), warnings.size() == 1 ? "" : "s",
                                                 fmt::join(warnings, ", ")));
  return fmt::format("verdict: {}\n", fmt::join(parts, "; "));
}

std::string errors_of(const Run& run) {
  std::string text = "\ngreatest errors at mesh points\n";
  const auto line = [&](const char* what, const char* symbol, const std::string& value, const std::string& besides) {
    text += fmt::format("  {:<24}{:<9}{:<11}{}\n", what, symbol, value, besides);
    text.erase(text.find_last_not_of(" \n") + 1) += '\n';
  };
  if (run.work.empty()) {
    line("energy", "e_H", short_text(run.e_H), run.health.worst_e_H + " of H's greatest term");
  } else {
    line("energy less work", "e_B", short_text(run.e_B), run.health.worst_e_H + " of its greatest term");
    line("energy", "e_H", short_text(run.e_H), "work is done");
  }
  if (!run.lambda.empty()) {
    line("constraints", "e_g", short_text(run.e_g), "condition of the Gram matrix " + run.health.condition);
    line("hidden constraints", "e_hid", short_text(run.e_hid),
         "velocity off the tangent space by " + run.health.worst_hidden);
    line("energy of output state", "delta_H", short_text(run.output_delta_H), "at the end");
  }
  for (const Warning& warning : run.health.warnings)
    text += fmt::format("WARNING {}: {}\n", warning.name, warning.text);
  return text;
}

/// What was raised, and to how many.
std::string nodes_of(const NodesReport::Raise& raise) {
  return raise.r > 0 ? fmt::format("r = {}", raise.r) : fmt::format("{}", raise.k);
}

/// What the program decided: the start, the nodes, the division of steps.
std::string decisions_of(const Run& run) {
  std::string text;
  if (!run.start_settled.empty()) text += fmt::format("the start is {}\n", run.start_settled);
  if (run.nodes) {
    text += fmt::format("k = {}{}: {}\n", run.nodes->k, run.nodes->r > 0 ? fmt::format(", r = {}", run.nodes->r) : "",
                        run.nodes->because);
    const auto& raised = run.nodes->raised;
    if (!raised.empty())
      text += fmt::format("raised to {}, {} times, first to {} in the step from t = {}\n", nodes_of(raised.back()),
                          raised.size(), nodes_of(raised.front()), raised.front().t);
    text += run.nodes->verdict + "\n";
  }
  if (run.halving) {
    const HalvingReport& halving = *run.halving;
    text += halving.steps == 0
                ? std::string("no step was divided\n")
                : fmt::format("{} divided, down to h/{}, first at t = {}\n",
                              halving.steps == 1 ? "1 step was" : fmt::format("{} steps were", halving.steps),
                              1L << halving.depth, halving.first_t);
  }
  return text.empty() ? text : "\n" + text;
}

std::string observed_in(const Run& run, bool all_digits) {
  std::string text;
  const auto shown = [&](const std::string& number) {
    return all_digits ? number : core::rounded_text(number, unassessed_digits);
  };
  if (!run.observables.empty()) text += "\nconserved by the exact motion\n";
  for (const Observed& o : run.observables)
    text += fmt::format("  {:<14} {}, changed by up to {}\n", o.name, o.initial, o.drift);
  if (!run.observations.empty()) text += "\nobserved at the end, and the range over mesh points\n";
  for (const Observation& o : run.observations)
    text += fmt::format("  {:<20} {}, from {} (t = {}) to {} (t = {})\n", o.name, shown(o.value), shown(o.least),
                        o.least_t, shown(o.greatest), o.greatest_t);
  return text;
}

/// The work done, and by whom.
std::string works_of(const Run& run) {
  if (run.work.empty()) return {};
  std::string text = fmt::format("\nwork done until the end: {}\n", core::rounded_text(run.work, unassessed_digits));
  for (const Work& work : run.works)
    text += fmt::format("  {:<32} {}\n", work.name, core::rounded_text(work.value, unassessed_digits));
  return text;
}

/// A number to its right digits; of none right, a mark.
std::string right_text(const std::string& number, double right) {
  return right < 1 ? "?" : core::rounded_text(number, static_cast<int>(right));
}

/// A vector of the output state in a table: the numbers, and with an error how many digits are right.
void add_column(Table& table, const std::string& symbol, const Texts& values, const std::vector<double>* digits) {
  table.columns.push_back(symbol);
  if (digits) table.columns.emplace_back("digits");
  auto& rows = table.groups.front().rows;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].push_back(digits ? right_text(values[i], (*digits)[i]) : core::rounded_text(values[i], unassessed_digits));
    if (digits) rows[i].push_back(fmt::format("{:.1f}", (*digits)[i]));
  }
}

/// A table with the numbers and the names of its rows.
Table rows_of(const std::string& heading, const std::string& what, const Texts& names) {
  Table table;
  table.columns = {"", what};
  table.groups = {{heading, {}, {}}};
  for (std::size_t i = 0; i < std::min(names.size(), most_rows); ++i)
    table.groups.front().rows.push_back({std::to_string(i + 1), names[i]});
  return table;
}

/// As text, with how many rows are left out.
std::string shown(const Table& table, std::size_t all) {
  std::string text = to_text(table);
  text.pop_back();
  return all <= most_rows ? text : text + fmt::format("  ... and {} more (--state)\n", all - most_rows);
}

std::string short_state(const Run& run) {
  const ErrorEstimate* const error = is_assessed(run) ? &*run.error : nullptr;
  std::string heading = fmt::format("\nstate at t = {}", run.t);
  if (error)
    heading += fmt::format(", to the digits that are right, against {}", compared_with(*error));
  else
    heading += fmt::format(", to {} digits, not assessed (all: --state)", unassessed_digits);
  if (run.error && !error)
    heading += fmt::format("\n{}, {} failed: {}", run.error->method, run.error->precision, run.error->failure);
  Table state = rows_of(heading, "coordinate", run.q_names);
  add_column(state, "q", run.q, error ? &error->q_digits : nullptr);
  add_column(state, "p", run.output_p, error ? &error->p_digits : nullptr);
  std::string text = shown(state, run.q.size());
  if (run.lambda.empty()) return text;
  Table multipliers = rows_of("", "constraint", run.lambda_names);
  add_column(multipliers, "lambda", run.output_lambda, error ? &error->lambda_digits : nullptr);
  return text + shown(multipliers, run.lambda.size());
}

/// Lines "  3  bob.x  0.123  15.2 digits": all digits of each number, and how many are right or survived rounding.
std::string list_of(const std::string& heading, const Texts& names, const Texts& values,
                    const std::vector<double>& digits) {
  const auto width = [](const Texts& texts) {
    std::size_t widest = 0;
    for (const std::string& text : texts) widest = std::max(widest, text.size());
    return widest;
  };
  std::string text = heading + "\n";
  for (std::size_t i = 0; i < values.size(); ++i) {
    text += fmt::format("  {:<4}{:<{}}  ", i + 1, names[i], width(names));
    text += digits.empty() ? values[i] : fmt::format("{:<{}}  {:.1f} digits", values[i], width(values), digits[i]);
    text += '\n';
  }
  return text;
}

/// "H(y_n) = H_0 within 3e-31 at all 100 steps"; or that this is not so.
std::string proved_of(const std::string& what, const std::string& most, const std::string& least, long steps) {
  if (least.empty()) return fmt::format("  {} within {} at all {} steps\n", what, most, steps);
  return fmt::format("  not {}: it is off by at most {}, and at one step by at least {}\n", what, most, least);
}

std::string proof_in(const Run& run, bool all_digits) {
  const ProvedSteps& proved = *run.proved;
  std::string text = fmt::format(
      "\nproved of the method without rounding\n"
      "  each of {} steps has a solution, and no other as near as {} of its momenta and multipliers\n"
      "  so has each step back, and it leads to where the step began\n",
      proved.steps, proved.only_within);
  text += proved_of("H(y_n) = H_0", proved.e_H, proved.e_H_least, proved.steps);
  if (!proved.lambda.empty()) text += proved_of("g(q_n) = 0", proved.e_g, proved.e_g_least, proved.steps);
  text += fmt::format("  q is known within {}, p within {}{}\n", proved.q_radius, proved.p_radius,
                      proved.lambda.empty() ? "" : ", lambda within " + proved.lambda_radius);
  text +=
      fmt::format("  rounding has moved the end of this run by at most {} in q, {} in p\n", proved.off_q, proved.off_p);
  text += fmt::format("  bounds grew by 10^{:.1f}, with {} digits and {:.1f} s\n", proved.growth, proved.working_digits,
                      proved.cpu_seconds);
  if (!all_digits) return text;
  text += list_of("q without rounding, proved", run.q_names, proved.q, {});
  text += list_of("p without rounding, proved", run.p_names, proved.p, {});
  if (proved.lambda.empty()) return text;
  return text + list_of("lambda of the last step without rounding, proved", proved.lambda_names, proved.lambda, {});
}

/// A state between mesh points, as that of the end is shown.
std::string between_of(const Run& run, const StateAt& at, bool all_digits) {
  const std::string heading = fmt::format("\nstate at t = {}", at.t);
  if (all_digits) {
    std::string text = list_of(heading + "\nq", run.q_names, at.q, {});
    text += list_of(at.lambda.empty() ? "p" : "p, tangential", run.p_names, at.p, {});
    return at.lambda.empty() ? text : text + list_of("lambda", run.lambda_names, at.lambda, {});
  }
  Table state = rows_of(heading, "coordinate", run.q_names);
  add_column(state, "q", at.q, nullptr);
  add_column(state, "p", at.p, nullptr);
  std::string text = shown(state, run.q_names.size());
  if (at.lambda.empty()) return text;
  Table multipliers = rows_of("", "constraint", run.lambda_names);
  add_column(multipliers, "lambda", at.lambda, nullptr);
  return text + shown(multipliers, run.lambda_names.size());
}

/// When events came, and how far those of one kind are apart.
std::string events_of(const Run& run, bool all_digits) {
  if (run.events.empty()) return {};
  const auto shown_time = [&](const std::string& t) {
    constexpr int digits = 15;
    return all_digits ? t : core::rounded_text(t, digits);
  };
  constexpr std::size_t most = 24;
  std::string text = "\nevents\n";
  std::size_t n = 0;
  for (const Event& event : run.events)
    if (n++ < most || all_digits)
      text += fmt::format("  {:<20} t = {}, {}\n", event.name, shown_time(event.t),
                          event.grazes  ? "grazes 0"
                          : event.rises ? "up"
                                        : "down");
  for (const EventPeriod& period : run.periods)
    text +=
        fmt::format("  {} {} again after {}{}\n", period.name, period.rises ? "up" : "down", shown_time(period.least),
                    period.least == period.greatest ? "" : " to " + shown_time(period.greatest));
  return n <= most || all_digits ? text : text + fmt::format("  ... and {} more (--state)\n", n - most);
}

/// When precisions have no digit left, and when that was seen.
std::string horizon_of(const DigitsLost& horizon) {
  if (!horizon.failure.empty()) return "\nhorizon: not known, as " + horizon.failure + "\n";
  std::string text = fmt::format("\nhorizon: by t = {:.6g} an error of the start grows by 10^{:.1f}\n",
                                 horizon.times.back(), horizon.lost.back());
  for (const Horizon& one : horizon.horizons)
    text += core::line_of(one, ", as far as is seen: less than one is lost in the second half");
  if (horizon.measured_t) text += fmt::format("  seen: this run had none at t = {:.4g}\n", *horizon.measured_t);
  return text;
}

std::string whole_state(const Run& run) {
  const ErrorEstimate error = is_assessed(run) ? *run.error : ErrorEstimate{};
  const Shadow shadow = run.shadow.value_or(Shadow{});
  const bool constrained = !run.lambda.empty();
  std::string text = fmt::format("\nstate at t = {}\n", run.t);
  if (is_assessed(run)) text += fmt::format("digits that are right, against {}\n", compared_with(error));
  const auto known = [](const std::vector<double>& right, const std::vector<double>& survived) {
    return right.empty() ? survived : right;
  };
  text += list_of("q", run.q_names, run.q, known(error.q_digits, shadow.q));
  text += list_of(constrained ? "p, propagated" : "p", run.p_names, run.p,
                  constrained ? shadow.p : known(error.p_digits, shadow.p));
  if (!constrained) return text;
  text += list_of("lambda, of the last step", run.lambda_names, run.lambda, {});
  text += list_of("p of the output state, projected to the tangent space", run.p_names, run.output_p, error.p_digits);
  return text + list_of("lambda of the output state", run.lambda_names, run.output_lambda, error.lambda_digits);
}

}  // namespace

std::string to_text(const Run& run, bool state) {
  std::string text = fmt::format("{}: {}\n", run.scene, run.title);
  text +=
      fmt::format("{}, {}, solver {}, {} steps of {}{} to t = {}\n", run.method, run.precision, run.solver, run.steps,
                  run.step, run.last_step.empty() ? "" : ", the last shortened to " + short_text(run.last_step), run.t);
  text += verdict_of(run) + errors_of(run) + decisions_of(run) + works_of(run) + observed_in(run, state);
  if (run.shadow) text += "\n" + core::to_text(*run.shadow);
  if (run.health.horizon) text += horizon_of(*run.health.horizon);
  if (run.proved) text += proof_in(run, state);
  text += events_of(run, state);
  for (const StateAt& one : run.at) text += between_of(run, one, state);
  text += state ? whole_state(run) : short_state(run);
  return text + fmt::format("\ncost: {:.2f} iterations per step, {:.3f} s of processor time\n", run.iterations_per_step,
                            run.cpu_seconds);
}

}  // namespace hbvm
