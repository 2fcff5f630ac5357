#pragma once

#include <string>
#include <vector>

#include "hbvm/solver/stage_solver.hpp"

namespace hbvm {

/// One line of the account of a run: an effect a scene names, or a part of the stage equations.
struct AccountLine {
  std::string name;
  bool effect = false;
  std::uint64_t calls = 0;
  std::uint64_t evaluations = 0;  ///< of an effect: nodes at which its force was evaluated
  OperationCounts operations;     ///< in all
  double seconds = 0;
};

/// What a run did, in the order in which a sweep does it.
struct Account {
  std::vector<AccountLine> lines;
  std::uint64_t steps = 0, sweeps = 0;
};

template <Scalar S>
Account account_of(const Problem<S>& problem, const SolverCounts& counts) {
  Account account;
  std::size_t t = 0;
  for (const EffectCount& count : counts.effects)
    account.lines.push_back({problem.potential.terms[t++].kind, true, count.calls, count.evaluations,
                             count.evaluations * count.per_evaluation, count.seconds});
  for (const PartCount& part : counts.parts)
    account.lines.push_back({part.name, false, part.calls, 0, part.calls * part.per_call, part.seconds});
  return account;
}

/// A table of the lines, with the share of the measured time and the sums.
std::string to_text(const Account& account);

}  // namespace hbvm
