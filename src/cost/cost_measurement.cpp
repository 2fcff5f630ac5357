#include "cost/cost_cell.hpp"
#include "long_work/json.hpp"

namespace hbvm::core {
namespace {

OrderedJson json_of(const CostErrors& errors) {
  return {{"q", json_number(errors.q)}, {"p", json_number(errors.p)}, {"lambda", json_number(errors.lambda)}};
}

CostErrors cost_errors_of(const OrderedJson& json) {
  return {number_of(json.at("q")), number_of(json.at("p")), number_of(json.at("lambda"))};
}

OrderedJson json_of(const AccountLine& line) {
  return {{"name", line.name},
          {"kind", static_cast<int>(line.kind)},
          {"operations", line.operations.total()},
          {"seconds", json_number(line.seconds)}};
}

/// f(name, field) of every field that is a number or a truth.
template <class Measurement, class F>
void for_each_number(Measurement& m, F f) {
  f("at_reference", m.at_reference);
  f("sweeps", m.sweeps);
  f("evaluations", m.evaluations);
  f("operations", m.operations);
  f("operations_in_double", m.operations_in_double);
  f("bytes", m.bytes);
  f("seconds", m.seconds);
  f("spread", m.spread);
  f("calibration", m.calibration);
  f("repetitions", m.repetitions);
  f("disturbed", m.disturbed);
  f("setup_seconds", m.setup_seconds);
  f("account_steps", m.account_steps);
}

}  // namespace

std::string to_result(const CostMeasurement& m) {
  if (!m.failure.empty()) return dumped({{"method", m.method}, {"failure", m.failure}}, -1);
  OrderedJson json{{"method", m.method}, {"failure", ""}, {"errors", json_of(m.errors)}, {"raw", json_of(m.raw)}};
  for_each_number(m, [&](const char* name, const auto& number) { json[name] = number; });
  json["account"] = OrderedJson::array();
  for (const AccountLine& line : m.account) json["account"].push_back(json_of(line));
  return dumped(json, -1);
}

CostMeasurement read_cost_measurement(const std::string& text) {
  return read_json(text, "a run of known cost", [](const OrderedJson& json) {
    CostMeasurement m;
    m.method = json.at("method");
    m.failure = json.at("failure");
    if (!m.failure.empty()) return m;
    m.errors = cost_errors_of(json.at("errors"));
    m.raw = cost_errors_of(json.at("raw"));
    for_each_number(m, [&](const char* name, auto& number) { json.at(name).get_to(number); });
    for (const OrderedJson& entry : json.at("account")) {
      AccountLine line{entry.at("name"), static_cast<AccountLine::Kind>(entry.at("kind").get<int>())};
      line.operations.add(Op::multiply, static_cast<Index>(entry.at("operations").get<std::uint64_t>()));
      line.seconds = number_of(entry.at("seconds"));
      m.account.push_back(std::move(line));
    }
    return m;
  });
}

}  // namespace hbvm::core
