#include "run/account.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace hbvm::core {
namespace {

OperationList list_of(const OperationCounts& counts) {
  OperationList list;
  for (std::size_t op = 0; op < op_count; ++op)
    list.emplace_back(name_of(static_cast<Op>(op)), counts[static_cast<Op>(op)]);
  return list;
}

}  // namespace

std::vector<AccountEntry> entries_of(const Account& account) {
  std::vector<AccountEntry> entries;
  for (const AccountLine& line : account.lines)
    entries.push_back({.name = line.name,
                       .effect = line.kind == AccountLine::Kind::effect,
                       .in_double = line.kind == AccountLine::Kind::in_double,
                       .calls = line.calls,
                       .evaluations = line.evaluations,
                       .operations = list_of(line.operations),
                       .done_before = line.done_before.total() > 0 ? list_of(line.done_before) : OperationList(),
                       .seconds = line.seconds});
  return entries;
}

void add_parts(Account& account, const std::vector<PartCount>& parts) {
  for (const PartCount& part : parts) {
    const AccountLine::Kind kind = part.in_double ? AccountLine::Kind::in_double : AccountLine::Kind::part;
    auto line = std::find_if(account.lines.begin(), account.lines.end(), [&](const AccountLine& candidate) {
      return candidate.kind == kind && candidate.name == part.name;
    });
    if (line == account.lines.end()) line = account.lines.insert(line, {part.name, kind});
    line->calls += part.calls;
    line->operations += part.calls * part.per_call;
    line->seconds += part.seconds;
  }
}

void balance(Account& account, double cpu_seconds, double elapsed_seconds) {
  double measured = 0;
  for (const AccountLine& line : account.lines) measured += line.seconds;
  const double elapsed = std::max(elapsed_seconds, measured);
  const double share = elapsed > 0 ? std::min(cpu_seconds / elapsed, double{1}) : 1;
  double left = cpu_seconds;
  for (AccountLine& line : account.lines) {
    line.seconds *= share;
    left -= line.seconds;
  }
  AccountLine rest{"rest of the steps", AccountLine::Kind::rest};
  rest.seconds = std::max(left, double{0});
  account.lines.push_back(rest);
}

std::string to_text(const Account& account) {
  using Kind = AccountLine::Kind;
  double seconds = 0;
  for (const AccountLine& line : account.lines) seconds += line.seconds;
  const auto share = [&](double time) { return seconds > 0 ? 100 * time / seconds : 0; };
  std::string text = fmt::format("{} steps, {} iterations\n", account.steps, account.sweeps);
  text += fmt::format("{:<42}{:>10}{:>12}{:>13}{:>13}{:>11}{:>10}{:>10}{:>8}\n", "", "calls", "evaluations", "add",
                      "multiply", "divide", "sqrt", "other", "time");
  const auto row = [&](const std::string& name, std::uint64_t calls, std::uint64_t evaluations,
                       const OperationCounts& n, double time) {
    const std::uint64_t adds = n[Op::add] + n[Op::subtract];
    const std::uint64_t others = n.total() - adds - n[Op::multiply] - n[Op::reciprocal] - n[Op::sqrt];
    const auto number = [](std::uint64_t count) { return count == 0 ? std::string() : std::to_string(count); };
    text +=
        fmt::format("{:<42}{:>10}{:>12}{:>13}{:>13}{:>11}{:>10}{:>10}{:>7.1f}%\n", name, number(calls),
                    number(evaluations), adds, n[Op::multiply], n[Op::reciprocal], n[Op::sqrt], others, share(time));
  };
  const auto section = [&](Kind kind, const char* heading, const char* name) {
    OperationCounts sum, done_before;
    double time = 0;
    bool any = false;
    for (const AccountLine& line : account.lines) {
      if (line.kind != kind || (line.calls == 0 && line.operations.total() == 0)) continue;
      if (!any) text += heading;
      any = true;
      row(line.name, line.calls, line.evaluations, line.operations, line.seconds);
      sum += line.operations;
      done_before += line.done_before;
      time += line.seconds;
    }
    if (any) row(name, 0, 0, sum, time);
    if (done_before.total() > 0) row("of these not done again, but in common", 0, 0, done_before, 0);
  };
  section(Kind::effect, "effects, in the working precision or in the digits that one of Newton's sweeps needs\n",
          "all effects");
  section(Kind::part, "parts of the solver, likewise\n", "all parts");
  section(Kind::in_double, "in double\n", "all in double");
  for (const AccountLine& line : account.lines)
    if (line.kind == Kind::rest)
      text += fmt::format("{:<42}{:>{}.1f}%\n", line.name, share(line.seconds), 10 + 12 + 13 + 13 + 11 + 10 + 10 + 7);
  return text;
}

}  // namespace hbvm::core
