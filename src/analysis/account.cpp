#include "hbvm/analysis/account.hpp"

#include <fmt/format.h>

namespace hbvm {

std::string to_text(const Account& account) {
  double seconds = 0;
  for (const AccountLine& line : account.lines) seconds += line.seconds;
  std::string text = fmt::format(
      "{} steps, {} iterations; operations, in the working precision or the digits that one of Newton's needs\n",
      account.steps, account.sweeps);
  text += fmt::format("{:<42}{:>10}{:>12}{:>13}{:>13}{:>11}{:>10}{:>10}{:>8}\n", "", "calls", "evaluations", "add",
                      "multiply", "divide", "sqrt", "other", "time");
  const auto row = [&](const std::string& name, std::uint64_t calls, std::uint64_t evaluations,
                       const OperationCounts& n, double time) {
    const std::uint64_t adds = n[Op::add] + n[Op::subtract];
    const std::uint64_t others = n.total() - adds - n[Op::multiply] - n[Op::reciprocal] - n[Op::sqrt];
    text +=
        fmt::format("{:<42}{:>10}{:>12}{:>13}{:>13}{:>11}{:>10}{:>10}{:>7.1f}%\n", name, calls, evaluations, adds,
                    n[Op::multiply], n[Op::reciprocal], n[Op::sqrt], others, seconds > 0 ? 100 * time / seconds : 0);
  };
  for (const bool effect : {true, false}) {
    OperationCounts sum;
    double time = 0;
    for (const AccountLine& line : account.lines) {
      if (line.effect != effect) continue;
      if (line.calls == 0 && line.operations.total() == 0) continue;
      row(line.name, line.calls, line.evaluations, line.operations, line.seconds);
      sum += line.operations;
      time += line.seconds;
    }
    row(effect ? "all effects" : "all of the solver", 0, 0, sum, time);
  }
  return text;
}

}  // namespace hbvm
