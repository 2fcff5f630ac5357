#pragma once

#include <string>
#include <vector>

#include "hbvm/run.hpp"
#include "solver/stage_solver.hpp"

namespace hbvm::core {

/// One line of the account of a run.
struct AccountLine {
  /// What it is about, in the order of the table.
  enum class Kind {
    effect,     ///< one that the scene names
    part,       ///< of the method and its solver, in the working precision or in fewer of its digits
    in_double,  ///< what a solver in more digits does in double
    rest        ///< the time of steps that is in no other line
  };
  std::string name;
  Kind kind = Kind::part;
  std::uint64_t calls = 0;
  std::uint64_t evaluations = 0;  ///< of an effect: nodes at which its force was evaluated
  OperationCounts operations{};   ///< in all
  double seconds = 0;             ///< of the processor
  OperationCounts done_before{};  ///< those of an effect's that are not done again, as one before it has done them
};

/// What the steps of a run did, in the order in which a sweep does it. Times of all lines add up to that of the steps.
struct Account {
  std::vector<AccountLine> lines;
  std::uint64_t steps = 0, sweeps = 0;
};

/// Lines of parts, one for those of the same name, whatever a call of each took.
void add_parts(Account& account, const std::vector<PartCount>& parts);

template <Scalar S>
Account account_of(const Problem<S>& problem, const SolverCounts& counts) {
  Account account;
  std::size_t t = 0;
  for (const EffectCount& count : counts.effects)
    account.lines.push_back({kind_of_effect(problem, t++), AccountLine::Kind::effect, count.calls, count.evaluations,
                             count.evaluations * count.per_evaluation, count.seconds,
                             count.evaluations * count.done_before});
  add_parts(account, counts.parts);
  return account;
}

/// Brings elapsed times to processor time, in proportion to the whole, and adds what of it is in no line. What was
/// measured of the lines is never more than the whole, whatever a busy machine did to either clock.
/// \param cpu_seconds, elapsed_seconds of all steps
void balance(Account& account, double cpu_seconds, double elapsed_seconds);

/// The lines as those who read a run are told of them.
std::vector<AccountEntry> entries_of(const Account& account);

/// A table of the lines, with the share of the time and the sums; operations in double have a sum of their own.
std::string to_text(const Account& account);

}  // namespace hbvm::core
