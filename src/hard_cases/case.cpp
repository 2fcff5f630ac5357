#include "hard_cases/case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace hbvm::core {
namespace {

bool holds_any(const std::vector<std::string>& list, const std::vector<std::string>& wanted) {
  return std::any_of(wanted.begin(), wanted.end(),
                     [&](const std::string& name) { return std::find(list.begin(), list.end(), name) != list.end(); });
}

/// How far a criterion is towards its bound, and beyond.
double reach(const Criterion& c) {
  const double infinity = std::numeric_limits<double>::infinity();
  if (!(c.value <= c.bound)) return std::isfinite(c.value) && c.bound > 0 ? c.value / c.bound : infinity;
  return c.bound > 0 ? c.value / c.bound : 0;
}

CaseFinding finding_of(const HardCase& c) {
  return {c.family, c.name, c.parameter, c.precision, c.expected.text(), CaseVerdict::not_as_expected, {}, {}, {}};
}

}  // namespace

std::string Expected::text() const {
  std::string text = to_hold ? "holds" : "";
  const auto add = [&](const std::string& other) { text += (text.empty() ? "" : " or ") + other; };
  for (const std::string& failure : failures) add(failure);
  for (const std::string& excuse : excuses) add("warns " + excuse);
  return warning.empty() ? text : text + ", warning " + warning;
}

std::string_view name_of(CaseVerdict verdict) {
  constexpr std::string_view names[] = {"holds", "typed failure, as expected", "warned, as expected",
                                        "not as expected"};
  return names[static_cast<int>(verdict)];
}

const Criterion* CaseFinding::deciding() const {
  const auto& all = result.criteria;
  const auto worst = std::max_element(all.begin(), all.end(),
                                      [](const Criterion& a, const Criterion& b) { return reach(a) < reach(b); });
  return worst == all.end() ? nullptr : &*worst;
}

CaseFinding judge(const HardCase& hard_case, CaseResult result) {
  const Expected& expected = hard_case.expected;
  CaseFinding finding = finding_of(hard_case);
  finding.result = std::move(result);
  const CaseResult& r = finding.result;
  if (!r.failure.empty()) {
    finding.reason = r.failure + ": " + r.message;
    if (holds_any({r.failure}, expected.failures)) finding.verdict = CaseVerdict::typed_failure;
    return finding;
  }
  const Criterion* const worst = finding.deciding();
  if (!worst) {
    finding.reason = r.message.empty() ? "nothing was measured" : r.message;
    return finding;
  }
  if (!worst->holds()) {
    finding.reason = fmt::format("{} is {:.3g}, above {:.3g}", worst->what, worst->value, worst->bound);
    if (!r.message.empty()) finding.reason += " (" + r.message + ")";
    if (holds_any(r.warnings, expected.excuses)) finding.verdict = CaseVerdict::warned;
    return finding;
  }
  if (!expected.to_hold) {
    finding.reason = "it runs to its end";
    return finding;
  }
  if (!expected.warning.empty() && !holds_any(r.warnings, {expected.warning})) {
    finding.reason = "the warning " + expected.warning + " is missing";
    if (!r.message.empty()) finding.reason += " (" + r.message + ")";
    return finding;
  }
  finding.verdict = CaseVerdict::holds;
  return finding;
}

CaseFinding lost(const HardCase& hard_case, const std::string& reason) {
  CaseFinding finding = finding_of(hard_case);
  finding.reason = reason;
  return finding;
}

}  // namespace hbvm::core
