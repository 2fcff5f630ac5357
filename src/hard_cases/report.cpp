#include "hard_cases/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hbvm/version.hpp"
#include "long_work/json.hpp"

namespace hbvm::core {
namespace {

using Json = OrderedJson;

std::string short_text(double x) { return std::isfinite(x) ? fmt::format("{:.3g}", x) : "---"; }

/// What decides, as the table shows it: the worst criterion, or how the run ended.
std::vector<std::string> decision(const CaseFinding& f) {
  if (!f.result.failure.empty()) return {f.result.failure, "---", "---"};
  const Criterion* const c = f.deciding();
  return c ? std::vector{c->what, short_text(c->value), short_text(c->bound)} : std::vector<std::string>(3, "---");
}

/// All that does not depend on when and where it was measured.
Json measured_of(const CaseFinding& f) {
  const Criterion* const c = f.deciding();
  Json json{{"case", f.name},
            {"parameter", f.parameter},
            {"precision", f.precision},
            {"expected", f.expected},
            {"verdict", name_of(f.verdict)},
            {"figure", c ? json_number(c->value) : Json(nullptr)},
            {"bound", c ? json_number(c->bound) : Json(nullptr)},
            {"unit", c ? c->what : ""},
            {"family", f.family},
            {"failure", f.result.failure},
            {"message", f.result.message},
            {"warnings", f.result.warnings},
            {"reason", f.reason}};
  json["criteria"] = Json::array();
  for (const Criterion& all : f.result.criteria)
    json["criteria"].push_back(
        {{"what", all.what}, {"value", json_number(all.value)}, {"bound", json_number(all.bound)}});
  return json;
}

/// What measured_of wrote. \throws nlohmann's exceptions
CaseFinding finding_of(const Json& j) {
  CaseFinding f{
      j.at("family"), j.at("case"), j.at("parameter"), j.at("precision"), j.at("expected"), {}, {}, j.at("reason"), {}};
  f.result.failure = j.at("failure");
  f.result.message = j.at("message");
  for (const Json& warning : j.at("warnings")) f.result.warnings.push_back(warning);
  for (const Json& c : j.at("criteria"))
    f.result.criteria.push_back({c.at("what"), number_of(c.at("value")), number_of(c.at("bound"))});
  const std::string verdict = j.at("verdict");
  f.verdict = CaseVerdict::not_as_expected;
  for (const auto known : {CaseVerdict::holds, CaseVerdict::typed_failure, CaseVerdict::warned})
    if (verdict == name_of(known)) f.verdict = known;
  return f;
}

}  // namespace

Table stability_table(const std::vector<CaseFinding>& findings) {
  Table table;
  table.caption = "Hard cases: what decides them, its figure and its bound";
  table.key_columns = {"family"};
  table.columns = {"case", "parameter", "precision", "expected", "what decides", "figure", "bound", "verdict"};
  for (const CaseFinding& f : findings) {
    if (table.groups.empty() || table.groups.back().heading != f.family)
      table.groups.push_back({f.family, {f.family}, {}});
    const std::vector<std::string> decided = decision(f);
    table.groups.back().rows.push_back({f.name, f.parameter, f.precision, f.expected, decided[0], decided[1],
                                        decided[2], std::string(name_of(f.verdict))});
  }
  return table;
}

std::string summary(const std::vector<CaseFinding>& findings) {
  int counts[4] = {};
  for (const CaseFinding& f : findings) ++counts[static_cast<int>(f.verdict)];
  return fmt::format("{} cases: {} hold, {} fail as expected, {} warn as expected, {} {} not as expected",
                     findings.size(), counts[0], counts[1], counts[2], counts[3], counts[3] == 1 ? "is" : "are");
}

std::string to_json(const std::vector<CaseFinding>& findings, const std::string& command) {
  Json cases = Json::array();
  for (const CaseFinding& f : findings) {
    cases.push_back(measured_of(f));
    cases.back()["cpu_seconds"] = f.cpu_seconds ? json_number(*f.cpu_seconds) : Json(nullptr);
  }
  return dumped({{"version", version()}, {"command", command}, {"summary", summary(findings)}, {"cases", cases}}, 1);
}

std::string to_result(const CaseFinding& finding) { return dumped(measured_of(finding), -1); }

CaseFinding read_case_result(const std::string& text) {
  return read_json(text, "a hard case", [](const Json& json) { return finding_of(json); });
}

}  // namespace hbvm::core
