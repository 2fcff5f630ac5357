#include "audit/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>

#include "hbvm/version.hpp"
#include "long_work/json.hpp"
#include "report/junit.hpp"
#include "step/hbvm_method.hpp"

namespace hbvm::core {
namespace {

using Json = OrderedJson;

std::string_view name_of(Form form) {
  constexpr std::string_view names[] = {"at least", "exactly", "round-off", "near", "digits"};
  return names[static_cast<int>(form)];
}
std::string_view name_of(Span span) { return span == Span::step ? "step" : "interval"; }

/// The names of claims' files, but for two that say little to who has not read those.
std::string_view readable(Quantity quantity) {
  return quantity == Quantity::lagmul   ? "extrapolated lambda"
         : quantity == Quantity::sweeps ? "iterations"
                                        : hbvm::core::name_of(quantity);
}

/// To three decimals, or a power of ten.
std::string short_text(double x) {
  if (!std::isfinite(x)) return "---";
  return std::abs(x) < 10'000 ? fmt::format("{:.3f}", x) : fmt::format("{:.1e}", x);
}

/// Lines would end the rows of a table.
std::string on_one_line(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < ' ') c = ' ';
  return text;
}

std::string predicted_text(const Claim& claim) {
  if (claim.form == Form::round_off) return "round-off";
  const std::string value = fmt::format("{}", claim.predicted);
  if (claim.form == Form::digits) return ">= " + value + " digits";
  return claim.form == Form::at_least ? ">= " + value : value;
}

Json evidence_of(const Finding& finding) {
  Json evidence = Json::array();
  for (const Ladder& ladder : finding.evidence) {
    Json steps = Json::array(), errors = Json::array(), floors = Json::array();
    for (const Rung& rung : ladder.rungs) {
      steps.push_back(rung.step);
      errors.push_back(json_number(rung.error));
      floors.push_back(json_number(rung.floor));
    }
    evidence.push_back(
        {{"precision", ladder.precision}, {"log2_h", steps}, {"log2_error", errors}, {"log2_floor", floors}});
  }
  return evidence;
}

/// All that does not depend on when and where it was measured.
Json measured_of(const Finding& f) {
  return {{"measured", json_number(f.measured)},
          {"uncertainty", json_number(f.uncertainty)},
          {"precision", f.precision},
          {"coefficients_to", f.coefficients_to > 0 ? Json(f.coefficients_to) : Json(nullptr)},
          {"interval", f.interval ? Json{f.interval->from, f.interval->to} : Json(nullptr)},
          {"verdict", name_of(f.verdict)},
          {"reason", f.reason},
          {"reference", f.reference},
          {"evidence", evidence_of(f)}};
}

Json json_of(const Finding& f) {
  const Claim& c = f.claim;
  const HbvmMethod* const hbvm = as_hbvm(*c.method);
  Json json{{"claim", c.label},
            {"quantity", hbvm::core::name_of(c.quantity)},
            {"problem", c.problem},
            {"method", c.method_text()},
            {"k", hbvm ? Json(hbvm->name().k) : Json(nullptr)},
            {"s", hbvm ? Json(hbvm->name().s) : Json(nullptr)},
            {"r", hbvm && hbvm->name().r > 0 ? Json(hbvm->name().r) : Json(nullptr)},
            {"over", name_of(c.span)},
            {"form", name_of(c.form)},
            {"predicted", c.predicted},
            {"seconds", json_number(f.seconds)}};
  json.update(measured_of(f));
  return json;
}

/// What measured_of wrote.
Finding finding_of(const Json& j) {
  Finding f;
  f.measured = number_of(j.at("measured"));
  f.uncertainty = number_of(j.at("uncertainty"));
  f.precision = j.at("precision");
  f.reason = j.at("reason");
  f.reference = j.at("reference");
  if (const Json& digits = j.at("coefficients_to"); !digits.is_null()) f.coefficients_to = digits;
  if (const Json& interval = j.at("interval"); !interval.is_null())
    f.interval = Interval{interval.at(0), interval.at(1)};
  const std::string verdict_text = j.at("verdict");
  for (const Verdict verdict :
       {Verdict::holds, Verdict::fails, Verdict::undecidable, Verdict::degenerate, Verdict::not_run})
    if (verdict_text == hbvm::core::name_of(verdict)) f.verdict = verdict;
  for (const Json& ladder : j.at("evidence")) {
    Ladder read{ladder.at("precision"), {}};
    for (std::size_t i = 0; i < ladder.at("log2_h").size(); ++i) {
      const Json& error = ladder.at("log2_error").at(i);
      read.rungs.push_back({ladder.at("log2_h").at(i),
                            error.is_null() ? -std::numeric_limits<double>::infinity() : error.get<double>(),
                            number_of(ladder.at("log2_floor").at(i))});
    }
    f.evidence.push_back(std::move(read));
  }
  return f;
}

}  // namespace

Table audit_table(const std::vector<Finding>& findings, bool with_reasons) {
  const bool named =
      std::any_of(findings.begin(), findings.end(), [](const Finding& f) { return !as_hbvm(*f.claim.method); });
  // Nodes for constraints are a column where a method says how many.
  const bool with_r = !named && std::any_of(findings.begin(), findings.end(),
                                            [](const Finding& f) { return as_hbvm(*f.claim.method)->name().r > 0; });
  Table table;
  table.caption = "Claims and what was measured";
  table.key_columns = {"problem"};
  table.columns = {"claim", "quantity", "over"};
  for (const char* const column : named ? std::vector{"method"} : std::vector{"k", "s"})
    table.columns.emplace_back(column);
  if (with_r) table.columns.emplace_back("r");
  for (const char* const column : {"predicted", "measured", "+-", "precision", "coefficients to", "verdict"})
    table.columns.emplace_back(column);
  if (with_reasons) table.columns.emplace_back("reason");
  std::map<std::string, std::size_t> places;
  for (const Finding& f : findings) {
    const Claim& c = f.claim;
    const auto [place, is_new] = places.try_emplace(c.problem, table.groups.size());
    if (is_new)
      table.groups.push_back({c.problem == "tableau" ? "coefficients" : c.problem, {on_one_line(c.problem)}, {}});
    const bool rate = (c.form == Form::at_least || c.form == Form::exactly) && c.problem != "tableau";
    std::vector<std::string> row{on_one_line(hbvm::core::readable(c.label)), std::string(readable(c.quantity)),
                                 rate ? std::string(name_of(c.span)) : ""};
    if (named) {
      row.push_back(on_one_line(c.method_text()));
    } else {
      const HbvmName& name = as_hbvm(*c.method)->name();
      for (const int number : {name.k, name.s}) row.push_back(std::to_string(number));
      if (with_r) row.push_back(name.r > 0 ? std::to_string(name.r) : "");
    }
    row.insert(row.end(), {predicted_text(c), short_text(f.measured), short_text(f.uncertainty), f.precision,
                           f.coefficients_to > 0 ? std::to_string(f.coefficients_to) : "---",
                           std::string(hbvm::core::name_of(f.verdict))});
    if (with_reasons) row.push_back(on_one_line(f.reason));
    table.groups[place->second].rows.push_back(std::move(row));
  }
  return table;
}

std::string summary(const std::vector<Finding>& findings) {
  int counts[5] = {};
  for (const Finding& f : findings) ++counts[static_cast<int>(f.verdict)];
  return fmt::format("{} claims: {} hold, {} fail, {} undecidable, {} of degenerate motions, {} not run",
                     findings.size(), counts[0], counts[1], counts[2], counts[3], counts[4]);
}

std::string to_json(const std::vector<Finding>& findings, const std::string& command) {
  Json claims = Json::array();
  for (const Finding& f : findings) claims.push_back(json_of(f));
  return dumped({{"version", version()}, {"command", command}, {"summary", summary(findings)}, {"claims", claims}}, 1);
}

std::string to_junit(const std::vector<Finding>& findings, const std::string& command) {
  using Outcome = JunitCase::Outcome;
  std::vector<JunitCase> cases;
  for (const Finding& f : findings)
    cases.push_back({.group = f.claim.problem,
                     .name = std::string(hbvm::core::name_of(f.claim.quantity)) + " of " + f.claim.method_text(),
                     .outcome = f.verdict == Verdict::holds   ? Outcome::passed
                                : f.verdict == Verdict::fails ? Outcome::failed
                                                              : Outcome::skipped,
                     .message = f.reason,
                     .seconds = f.seconds});
  return junit_xml(command, cases);
}

std::string to_result(const std::vector<Finding>& findings) {
  Json result = Json::array();
  for (const Finding& f : findings) result.push_back(measured_of(f));
  return dumped(result, -1);
}

std::vector<Finding> read_result(const std::string& text) {
  return read_json(text, "an audit", [](const Json& all) {
    std::vector<Finding> findings;
    for (const Json& finding : all) findings.push_back(finding_of(finding));
    return findings;
  });
}

}  // namespace hbvm::core
