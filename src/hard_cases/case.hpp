#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hbvm::core {

/// A number that must not exceed its bound; NaN does.
struct Criterion {
  std::string what;
  double value = 0, bound = 0;

  bool holds() const { return value <= bound; }
};

/// How a hard case may end.
struct Expected {
  bool to_hold = true;                ///< with every criterion within its bound
  std::vector<std::string> failures;  ///< or with one of these: a name of FailureCause, or "refused" for an InputError
  std::vector<std::string> excuses;   ///< or with a criterion out of its bound, if one of these warnings says so
  std::string warning;                ///< a warning that must be given

  /// "holds", "holds or stage_equations_diverge", "holds, warning near_singular_constraints".
  std::string text() const;
};

/// What running a hard case showed.
struct CaseResult {
  std::vector<Criterion> criteria;
  std::vector<std::string> warnings;
  std::string failure;  ///< name of the cause; empty if it ran to its end
  std::string message;  ///< of the failure, or what else a reader wants to know
};

/// One hard case: how it is run, and how it may end. `run` keeps nothing between calls and throws nothing that is not
/// a mistake of the program.
struct HardCase {
  std::string family, name, parameter, precision;
  Expected expected;
  double seconds = 0;  ///< of processor time; more counts as a hang
  std::function<CaseResult()> run;

  std::string key() const { return family + "|" + name + "|" + parameter + "|" + precision; }
};

enum class CaseVerdict {
  holds,          ///< every criterion does
  typed_failure,  ///< it failed as it may
  warned,         ///< a criterion does not hold, and a warning says so
  not_as_expected
};
/// "holds", "typed failure, as expected", "warned, as expected", "not as expected".
std::string_view name_of(CaseVerdict verdict);

/// What is kept of a case that ran.
struct CaseFinding {
  std::string family, name, parameter, precision, expected;
  CaseVerdict verdict = CaseVerdict::not_as_expected;
  CaseResult result;
  std::string reason;                 ///< of a verdict that is not "holds"
  std::optional<double> cpu_seconds;  ///< that it took, unless it was known from before

  /// The criterion that is worst off, value over bound. \return null if there is none
  const Criterion* deciding() const;
};

/// Whether a case ended as it may: anything else is not as expected, above all a run without a criterion.
CaseFinding judge(const HardCase& hard_case, CaseResult result);

/// A case that never came to a result: a crash, or no end in its time.
CaseFinding lost(const HardCase& hard_case, const std::string& reason);

}  // namespace hbvm::core
