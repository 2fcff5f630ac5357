#include <cmath>

#include "door/horizon_text.hpp"
#include "door/run_of.hpp"
#include "hbvm/run.hpp"
#include "hbvm/version.hpp"
#include "long_work/json.hpp"

namespace hbvm {
namespace core {

OrderedJson json_of(const std::vector<Warning>& warnings) {
  OrderedJson list = OrderedJson::array();
  for (const Warning& warning : warnings) list.push_back({{"name", warning.name}, {"text", warning.text}});
  return list;
}

}  // namespace core

namespace {

std::vector<double> rounded(std::vector<double> digits) {
  for (double& d : digits) d = std::round(100 * d) / 100;
  return digits;
}

core::OrderedJson json_of(const DigitsLost& horizon) {
  if (!horizon.failure.empty()) return {{"failure", horizon.failure}};
  core::OrderedJson j{{"growth", core::OrderedJson::array()}, {"precisions", core::OrderedJson::array()}};
  for (std::size_t n = 0; n < horizon.times.size(); ++n)
    j["growth"].push_back({{"t", horizon.times[n]}, {"digits_lost", rounded({horizon.lost[n]}).front()}});
  for (const Horizon& one : horizon.horizons) j["precisions"].push_back(core::json_of(one));
  j["measured_t"] = horizon.measured_t ? core::json_number(*horizon.measured_t) : core::OrderedJson(nullptr);
  return j;
}

core::OrderedJson json_of(const Health& health) {
  core::OrderedJson j{{"condition", health.condition},
                      {"worst_e_H", health.worst_e_H},
                      {"worst_hidden", health.worst_hidden},
                      {"warnings", core::json_of(health.warnings)}};
  if (health.horizon) j["horizon"] = json_of(*health.horizon);
  return j;
}

core::OrderedJson json_of(const ErrorEstimate& error) {
  // A stored reference was not made by a run beside.
  const auto beside = [](const std::string& text) {
    return text.empty() ? core::OrderedJson(nullptr) : core::OrderedJson(text);
  };
  core::OrderedJson j{
      {"reference", error.reference}, {"method", beside(error.method)}, {"precision", beside(error.precision)}};
  if (!error.failure.empty()) {
    j["failure"] = error.failure;
    return j;
  }
  std::vector<double> digits = error.q_digits;
  digits.insert(digits.end(), error.p_digits.begin(), error.p_digits.end());
  j["q"] = error.q;
  j["p"] = error.p;
  j["lambda"] = error.lambda.empty() ? core::OrderedJson(nullptr) : core::OrderedJson(error.lambda);
  j["digits"] = rounded(digits);
  j["lambda_digits"] = rounded(error.lambda_digits);
  return j;
}

core::OrderedJson json_of(const Shadow& shadow) {
  if (!shadow.failure.empty()) return {{"precision", shadow.precision}, {"failure", shadow.failure}};
  return {{"precision", shadow.precision},
          {"digits", {{"q", rounded(shadow.q)}, {"p", rounded(shadow.p)}}},
          {"worst",
           {{"component", shadow.worst.component},
            {"digits", rounded({shadow.worst.digits}).front()},
            {"t", shadow.worst.t},
            {"every", shadow.every}}}};
}

core::OrderedJson json_of(const ProvedSteps& proved) {
  const auto or_null = [](const std::string& text) {
    return text.empty() ? core::OrderedJson(nullptr) : core::OrderedJson(text);
  };
  return {{"steps", proved.steps},
          {"digits", proved.digits},
          {"working_digits", proved.working_digits},
          {"growth", rounded({proved.growth}).front()},
          {"only_within", proved.only_within},
          {"q", proved.q},
          {"p", proved.p},
          {"lambda", proved.lambda},
          {"lambda_names", proved.lambda_names},
          {"radius", {{"q", proved.q_radius}, {"p", proved.p_radius}, {"lambda", or_null(proved.lambda_radius)}}},
          {"e_H", proved.e_H},
          {"e_H_least", or_null(proved.e_H_least)},
          {"e_g", or_null(proved.e_g)},
          {"e_g_least", or_null(proved.e_g_least)},
          {"off", {{"q", proved.off_q}, {"p", proved.off_p}}},
          {"cpu_seconds", proved.cpu_seconds}};
}

/// The mesh points, each with the output state as the end has it.
core::OrderedJson states_of(const Run& run) {
  const std::size_t m = run.q.size(), nu = run.lambda.size();
  core::OrderedJson states = core::OrderedJson::array();
  for (const std::vector<std::string>& row : run.trajectory.rows) {
    auto cell = row.begin();
    const auto next = [&](std::size_t count) {
      const auto first = cell;
      cell += static_cast<std::ptrdiff_t>(count);
      return std::vector<std::string>(first, cell);
    };
    core::OrderedJson state{{"t", next(1).front()}};
    state["q"] = next(m);
    state["p"] = next(m);
    state["lambda"] = next(nu);
    state["output"]["p"] = next(m);
    state["output"]["lambda"] = next(nu);
    constexpr std::ptrdiff_t errors = 3;  // delta_H, g, hidden
    cell += errors;
    for (const Observation& o : run.observations) state["observed"][o.name] = next(1).front();
    states.push_back(std::move(state));
  }
  return states;
}

}  // namespace

std::string to_json(const Run& run, bool states) {
  core::OrderedJson j;
  j["scene"] = run.scene;
  j["method"] = run.method;
  j["solver"] = run.solver;
  j["precision"] = run.precision;
  j["step"] = run.step;
  j["until"] = run.until;
  if (!run.last_step.empty()) j["last_step"] = run.last_step;
  if (run.reverse) j["reverse"] = true;
  if (!run.start.empty()) j["start"] = run.start;
  if (!run.start_settled.empty()) j["start_settled"] = run.start_settled;
  j["steps"] = run.steps;
  j["names"] = {{"q", run.q_names}, {"p", run.p_names}, {"lambda", run.lambda_names}};
  j["t"] = run.t;
  j["q"] = run.q;
  j["p"] = run.p;
  j["q_carry"] = run.q_carry;
  j["p_carry"] = run.p_carry;
  j["lambda"] = run.lambda;
  j["output"] = {{"p", run.output_p}, {"lambda", run.output_lambda}, {"delta_H", run.output_delta_H}};
  if (states) j["states"] = states_of(run);
  for (const Event& event : run.events) {
    j["events"].push_back({{"name", event.name},
                           {"t", event.t},
                           {"direction", event.grazes  ? "grazes"
                                         : event.rises ? "up"
                                                       : "down"},
                           {"q", event.q},
                           {"p", event.p},
                           {"lambda", event.lambda}});
    for (std::size_t n = 0; n < event.observed.size(); ++n)
      j["events"].back()["observed"][run.observations[n].name] = event.observed[n];
  }
  for (const EventPeriod& period : run.periods)
    j["periods"].push_back({{"name", period.name},
                            {"direction", period.rises ? "up" : "down"},
                            {"crossings", period.crossings},
                            {"least", period.least},
                            {"greatest", period.greatest}});
  for (const StateAt& state : run.at)
    j["at"].push_back(
        {{"t", state.t}, {"q", state.q}, {"p", state.p}, {"lambda", state.lambda}, {"delta_H", state.delta_H}});
  j["e_H"] = run.e_H;
  j["e_g"] = run.e_g;
  j["e_hid"] = run.e_hid;
  if (!run.work.empty()) {
    j["e_B"] = run.e_B;
    j["work"] = {{"total", run.work}, {"by", core::OrderedJson::object()}};
    for (const Work& work : run.works) j["work"]["by"][work.name] = work.value;
  }
  j["health"] = json_of(run.health);
  if (run.shadow) j["shadow"] = json_of(*run.shadow);
  if (run.error) j["error"] = json_of(*run.error);
  if (run.proved) j["proved"] = json_of(*run.proved);
  j["iterations_per_step"] = run.iterations_per_step;
  j["cpu_seconds"] = run.cpu_seconds;
  if (run.nodes) {
    core::OrderedJson raised = core::OrderedJson::array();
    for (const auto& raise : run.nodes->raised) {
      raised.push_back({{"t", raise.t}, {"k", raise.k}});
      if (raise.r > 0) raised.back()["r"] = raise.r;
    }
    j["chosen"] = {{"k", run.nodes->k},
                   {"because", run.nodes->because},
                   {"raised", raised},
                   {"verified", run.nodes->verified},
                   {"verdict", run.nodes->verdict}};
    if (run.nodes->r > 0) j["chosen"]["r"] = run.nodes->r;
  }
  if (run.halving) {
    const HalvingReport& halving = *run.halving;
    j["halved"] = {{"steps", halving.steps}, {"substeps", halving.substeps}};
    if (halving.steps > 0) {
      j["halved"]["smallest"] = halving.smallest;
      j["halved"]["first_t"] = halving.first_t;
    } else {
      j["halved"]["smallest"] = j["halved"]["first_t"] = nullptr;
    }
  }
  if (run.observes) {
    j["observables"] = core::OrderedJson::object();
    for (const Observed& o : run.observables) j["observables"][o.name] = {{"initial", o.initial}, {"drift", o.drift}};
  }
  for (const Observation& o : run.observations) {
    j["observed"][o.name] = o.value;
    j["observed_range"][o.name] = {
        {"least", o.least}, {"least_t", o.least_t}, {"greatest", o.greatest}, {"greatest_t", o.greatest_t}};
  }
  if (!run.account.empty()) {
    j["account"] = core::OrderedJson::array();
    for (const AccountEntry& line : run.account) {
      core::OrderedJson entry{
          {"name", line.name}, {"effect", line.effect}, {"in_double", line.in_double}, {"calls", line.calls}};
      if (line.effect) entry["evaluations"] = line.evaluations;
      for (const auto& [name, count] : line.operations) entry["operations"][name] = count;
      for (const auto& [name, count] : line.done_before) entry["done_before"][name] = count;
      entry["seconds"] = line.seconds;
      j["account"].push_back(entry);
    }
  }
  j["version"] = version();
  j["command"] = run.command;
  j["title"] = run.title;
  j["scene_text"] = run.scene_toml;
  return j.dump(2, ' ', false, core::OrderedJson::error_handler_t::replace);  // a path need not be UTF-8
}

}  // namespace hbvm
