#include "audit/report.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "hard_cases/not_finite.hpp"
#include "step/hbvm_method.hpp"
#include "step/tableau_method.hpp"

namespace hbvm::core {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

Finding finding(const std::string& label = "ord2s", const std::string& problem = "kepler") {
  Finding f;
  f.claim.label = label;
  f.claim.quantity = Quantity::tangential_p;
  f.claim.problem = problem;
  f.claim.method = hbvm_of({3, 2});
  f.claim.span = Span::step;
  f.claim.predicted = 5;
  f.verdict = Verdict::fails;
  f.measured = double{10} / 3;
  f.uncertainty = double{1} / 7;
  f.precision = "mpfr:50";
  f.reference = "closed form";
  f.reason = "the error has another rate";
  f.coefficients_to = 997;
  f.interval = Interval{double{1} / 3, 7};
  f.seconds = double{1} / 9;
  f.evidence = {{"double", {{-1, -10, -50}, {-2, double{-40} / 3, -50}, {-3, -infinity, -50}}},
                {"mpfr:50", {{-1, -1'000'000, -2'000'000}}}};
  return f;
}
Finding of_tableau(const std::string& name) {
  Finding f = finding();
  f.claim.method = std::make_shared<const TableauMethod>(Tableau{name, {}, {}, {}, {}}, "");
  return f;
}

void expect_same(const Finding& a, const Finding& b) {
  const auto expect_number = [](double x, double y, const char* what) {
    EXPECT_TRUE(x == y || (std::isnan(x) && std::isnan(y))) << what << ": " << x << " and " << y;
  };
  EXPECT_EQ(a.verdict, b.verdict);
  expect_number(a.measured, b.measured, "measured");
  expect_number(a.uncertainty, b.uncertainty, "uncertainty");
  EXPECT_EQ(a.precision, b.precision);
  EXPECT_EQ(a.reference, b.reference);
  EXPECT_EQ(a.reason, b.reason);
  EXPECT_EQ(a.coefficients_to, b.coefficients_to);
  ASSERT_EQ(a.interval.has_value(), b.interval.has_value());
  if (a.interval) {
    expect_number(a.interval->from, b.interval->from, "from");
    expect_number(a.interval->to, b.interval->to, "to");
  }
  ASSERT_EQ(a.evidence.size(), b.evidence.size());
  for (std::size_t n = 0; n < a.evidence.size(); ++n) {
    EXPECT_EQ(a.evidence[n].precision, b.evidence[n].precision);
    ASSERT_EQ(a.evidence[n].rungs.size(), b.evidence[n].rungs.size());
    for (std::size_t r = 0; r < a.evidence[n].rungs.size(); ++r) {
      const Rung &x = a.evidence[n].rungs[r], &y = b.evidence[n].rungs[r];
      expect_number(x.step, y.step, "step");
      expect_number(x.error, y.error, "error");
      expect_number(x.floor, y.floor, "floor");
    }
  }
}

TEST(AuditResults, AreReadBackToTheLastBit) {
  Finding round_off = finding();
  round_off.measured = round_off.uncertainty = nan_value;
  round_off.verdict = Verdict::holds;
  Finding open = of_tableau("Radau \"IIA\", two\nstages \xC3\xA9");
  open.verdict = Verdict::undecidable;
  open.evidence.clear();
  open.coefficients_to = 0;
  open.interval.reset();
  const std::vector<Finding> findings{finding(), round_off, open};
  const std::string text = to_result(findings);
  EXPECT_EQ(text.find('\n'), std::string::npos) << text;
  const std::vector<Finding> read = read_result(text);
  ASSERT_EQ(read.size(), findings.size());
  for (std::size_t i = 0; i < read.size(); ++i) expect_same(read[i], findings[i]);
}

/// It depends on no clock.
TEST(AuditResults, HoldNoTime) {
  Finding slow = finding();
  slow.seconds = 1'000;
  EXPECT_EQ(to_result({slow}), to_result({finding()}));
}

TEST(AuditResults, OfWrongTypesAreRefused) {
  const Json good = Json::parse(to_result({finding()}));
  EXPECT_NO_THROW(read_result(good.dump()));
  const auto expect_refused = [&](const Json& result) {
    EXPECT_THROW(read_result(result.dump()), InputError) << result;
  };
  for (const Json& other : {Json(1), Json("text"), Json::array({1})}) expect_refused(other);
  for (const char* const key : {"measured", "uncertainty", "precision", "reason", "reference", "verdict", "evidence",
                                "coefficients_to", "interval"}) {
    Json result = good;
    result[0].erase(key);
    expect_refused(result);
  }
  for (const char* const key : {"precision", "reason", "reference", "verdict", "evidence"}) {
    Json result = good;
    result[0][key] = 5;
    expect_refused(result);
  }
  for (const char* const key : {"log2_h", "log2_error", "log2_floor"}) {
    Json result = good;
    result[0]["evidence"][0][key] = "text";
    expect_refused(result);
  }
}

TEST(AuditJson, HasTheFieldsOfEachClaim) {
  const Json json = Json::parse(to_json({finding(), finding()}, "hbvm audit --full"));
  EXPECT_EQ(json.at("command"), "hbvm audit --full");
  EXPECT_FALSE(json.at("version").get<std::string>().empty());
  EXPECT_EQ(json.at("summary"), "2 claims: 0 hold, 2 fail, 0 undecidable, 0 of degenerate motions, 0 not run");
  ASSERT_EQ(json.at("claims").size(), 2u);
  const Json& claim = json.at("claims").at(0);
  EXPECT_EQ(claim.at("claim"), "ord2s");
  EXPECT_EQ(claim.at("quantity"), "tangential p");
  EXPECT_EQ(claim.at("problem"), "kepler");
  EXPECT_EQ(claim.at("method"), "HBVM(3,2)");
  EXPECT_EQ(claim.at("k"), 3);
  EXPECT_EQ(claim.at("s"), 2);
  EXPECT_EQ(claim.at("over"), "step");
  EXPECT_EQ(claim.at("form"), "at least");
  EXPECT_EQ(claim.at("predicted"), 5);
  EXPECT_EQ(claim.at("measured"), double{10} / 3);
  EXPECT_EQ(claim.at("uncertainty"), double{1} / 7);
  EXPECT_EQ(claim.at("precision"), "mpfr:50");
  EXPECT_EQ(claim.at("verdict"), "fails");
  EXPECT_EQ(claim.at("reason"), "the error has another rate");
  EXPECT_EQ(claim.at("reference"), "closed form");
  EXPECT_EQ(claim.at("coefficients_to"), 997);
  EXPECT_EQ(claim.at("interval"), Json::array({double{1} / 3, 7}));
  EXPECT_EQ(claim.at("seconds"), double{1} / 9);
  const Json& evidence = claim.at("evidence");
  ASSERT_EQ(evidence.size(), 2u);
  EXPECT_EQ(evidence.at(0).at("precision"), "double");
  EXPECT_EQ(evidence.at(0).at("log2_h"), Json({-1.0, -2.0, -3.0}));
  EXPECT_TRUE(evidence.at(0).at("log2_error").at(2).is_null()) << "JSON has no infinity";
  EXPECT_EQ(evidence.at(0).at("log2_floor").at(1), -50);
}

TEST(AuditJson, HasNullForWhatIsNotThere) {
  Finding f = of_tableau("midpoint");
  f.measured = f.uncertainty = nan_value;
  const Json claim = Json::parse(to_json({f}, "")).at("claims").at(0);
  EXPECT_EQ(claim.at("method"), "midpoint");
  for (const char* const key : {"k", "s", "measured", "uncertainty"}) EXPECT_TRUE(claim.at(key).is_null()) << key;
}

TEST(AuditJson, NamesFormsAndSpans) {
  const auto field = [](const char* key, const auto& change) {
    Finding f = finding();
    change(f.claim);
    return Json::parse(to_json({f}, "")).at("claims").at(0).at(key).get<std::string>();
  };
  EXPECT_EQ(field("form", [](Claim& c) { c.form = Form::exactly; }), "exactly");
  EXPECT_EQ(field("form", [](Claim& c) { c.form = Form::round_off; }), "round-off");
  EXPECT_EQ(field("form", [](Claim& c) { c.form = Form::near; }), "near");
  EXPECT_EQ(field("over", [](Claim& c) { c.span = Span::interval; }), "interval");
}

/// Names of files may hold any byte.
TEST(AuditJson, IsJsonWhateverTheNames) {
  for (const char* const name : {"\xFF.toml", "a\"b\\c\n", "\x01"}) {
    const std::string text = to_json({finding("ord2s", name)}, name);
    EXPECT_EQ(Json::parse(text).at("claims").size(), 1u);
    EXPECT_TRUE(Json::accept(to_result({finding("ord2s", name)})));
  }
}

TEST(AuditJson, OfNothingIsEmpty) { EXPECT_TRUE(Json::parse(to_json({}, "")).at("claims").empty()); }

TEST(AuditTable, HasOneGroupAProblem) {
  const Table table = audit_table({finding("a", "kepler"), finding("b", "tableau"), finding("c", "kepler")});
  ASSERT_EQ(table.groups.size(), 2u);
  EXPECT_EQ(table.key_columns, std::vector<std::string>{"problem"});
  EXPECT_EQ(table.groups[0].heading, "kepler");
  EXPECT_EQ(table.groups[0].keys, std::vector<std::string>{"kepler"});
  ASSERT_EQ(table.groups[0].rows.size(), 2u);
  EXPECT_EQ(table.groups[0].rows[0][0], "a");
  EXPECT_EQ(table.groups[0].rows[1][0], "c");
  EXPECT_EQ(table.groups[1].heading, "coefficients");
  EXPECT_EQ(table.groups[1].rows.size(), 1u);
}

TEST(AuditTable, HasKAndS) {
  const Table table = audit_table({finding()});
  EXPECT_EQ(table.columns, (std::vector<std::string>{"claim", "quantity", "over", "k", "s", "predicted", "measured",
                                                     "+-", "precision", "coefficients to", "verdict"}));
  EXPECT_EQ(table.groups.at(0).rows.at(0),
            (std::vector<std::string>{"Theorem 5 (ord2s)", "tangential p", "step", "3", "2", ">= 5", "3.333", "0.143",
                                      "mpfr:50", "997", "fails"}));
}

TEST(AuditTable, HasMethodsIfOneIsATableau) {
  const Table table = audit_table({of_tableau("midpoint"), finding()});
  EXPECT_EQ(table.columns, (std::vector<std::string>{"claim", "quantity", "over", "method", "predicted", "measured",
                                                     "+-", "precision", "coefficients to", "verdict"}));
  EXPECT_EQ(table.groups.at(0).rows.at(0).at(3), "midpoint");
  EXPECT_EQ(table.groups.at(0).rows.at(1).at(3), "HBVM(3,2)");
  for (const auto& row : table.groups[0].rows) EXPECT_EQ(row.size(), table.columns.size());
}

TEST(AuditTable, ShowsEachForm) {
  const auto row = [](Form form, double predicted, double measured) {
    Finding f = finding();
    f.claim.form = form;
    f.claim.predicted = predicted;
    f.measured = measured;
    const Table table = audit_table({f});
    return table.groups.at(0).rows.at(0);
  };
  EXPECT_EQ(row(Form::exactly, 4, 4).at(5), "4");
  EXPECT_EQ(row(Form::round_off, 0, 12).at(5), "round-off");
  EXPECT_EQ(row(Form::round_off, 0, 12).at(2), "") << "it is looked at over an interval only";
  EXPECT_EQ(row(Form::near, 1, 1).at(5), "1");
  EXPECT_EQ(row(Form::at_least, 4, nan_value).at(6), "---");
  EXPECT_EQ(row(Form::at_least, 4, infinity).at(6), "---");
  EXPECT_EQ(row(Form::round_off, 0, 123'456).at(6), "1.2e+05");
}

TEST(AuditTable, CellsHoldNoLines) {
  Finding f = of_tableau("Gauss, two | stages\nof order 4");
  f.claim.label = "one, two | three\nfour";
  f.claim.problem = "a,b.toml";
  const Table table = audit_table({f});
  for (const auto& group : table.groups) {
    for (const std::string& key : group.keys) EXPECT_EQ(key.find('\n'), std::string::npos) << key;
    for (const auto& row : group.rows)
      for (const std::string& cell : row) EXPECT_EQ(cell.find('\n'), std::string::npos) << cell;
  }
  EXPECT_NE(to_csv(table).find("\n\"a,b.toml\",\"one, two | three four\","), std::string::npos) << to_csv(table);
}

TEST(AuditTable, OfNothingHasNoGroups) { EXPECT_TRUE(audit_table({}).groups.empty()); }

TEST(AuditSummary, CountsVerdicts) {
  EXPECT_EQ(summary({}), "0 claims: 0 hold, 0 fail, 0 undecidable, 0 of degenerate motions, 0 not run");
  std::vector<Finding> findings(9);
  findings[0].verdict = findings[1].verdict = findings[2].verdict = Verdict::holds;
  findings[3].verdict = findings[4].verdict = Verdict::fails;
  findings[6].verdict = findings[7].verdict = Verdict::degenerate;
  findings[8].verdict = Verdict::not_run;
  EXPECT_EQ(summary(findings), "9 claims: 3 hold, 2 fail, 1 undecidable, 2 of degenerate motions, 1 not run");
}

}  // namespace
}  // namespace hbvm::core
