#pragma once

#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <set>

#include "audit/audit.hpp"
#include "claim_group.hpp"
#include "coefficients.hpp"
#include "motion.hpp"
#include "scalar/precision.hpp"

namespace hbvm::core {

/// The motions of the problems that were looked at, for all threads.
class Motions {
 public:
  /// \throws as motion_of does, every time
  Motion of(const std::string& problem);

 private:
  std::mutex mutex_;
  std::map<std::string, Motion> known_;
};

/// Decides the claims of one unit of work; the findings go to the claims' places.
class Auditor {
 public:
  enum class Kind { rates, round_off, tableau, special, digits };
  static Kind kind_of(const Claim& claim);

  /// Claims of one kind about one method on one problem: what one series of runs decides.
  struct Unit {
    Kind kind;
    std::vector<std::size_t> members;  ///< places of the claims
  };

  Auditor(const std::vector<Claim>& claims, const Unit& unit, const AuditOptions& options, Motions& motions,
          std::vector<Finding>& findings);

  /// What cannot be run, or not in the time there is, is found to be so; nothing but Interrupted is thrown.
  void work();

 private:
  Finding& finding(std::size_t c) { return findings_[unit_.members[c]]; }
  std::string reference() const;

  /// Precisions in the order in which they are tried: of decimals none that shows much more than they have.
  std::vector<Precision> levels() const;
  std::string decimals_text() const;
  std::string near_the_start() const;

  void prepare();
  void decide();
  void follow_steps();
  void follow_intervals();
  void conserve();
  void check_tableau();
  /// In some digits more than are claimed, at steps of half and a quarter of the interval and so on.
  void count_digits();
  void measure_special();
  void measure_tableau();
  std::string words_on_order(const Finding& f, int found) const;

  /// Raises the precision, over at least so many levels, until every claim of those given is decided.
  template <class Measure>
  void climb(const std::vector<std::size_t>& members, std::size_t at_least, const Measure& measure);
  unsigned least_digits() const;
  void take(Finding& f, const std::vector<Rung>& rungs, const Precision& precision);
  /// An error over an interval falls no faster than that of its first step. The latter can be followed far deeper: to
  /// where a wrong 25th digit of a coefficient takes over.
  void compare_with_one_step();
  /// One run of all claims about conservation in one precision; the worst of all counts.
  void conserve_in(const Precision& precision, int log2_step, long steps);
  void fail(Finding& f, const std::string& reason);
  /// What was measured to be so may still be due to the motion, or not to the coefficients.
  void weigh(Finding& f);
  void weigh_coefficients(Finding& f);

  ClaimGroup group_;
  const Unit& unit_;
  const AuditOptions& options_;
  Motions& motions_;
  std::vector<Finding>& findings_;
  Motion motion_;
  std::optional<CoefficientCheck> coefficients_;
  std::vector<std::size_t> steps_, intervals_;  ///< claims about a step, and about an interval
  std::optional<Ladders> deep_;                 ///< the errors of one step with 100 digits
  std::set<std::size_t> settled_;               ///< claims whose verdict what is left to do cannot change
};

}  // namespace hbvm::core
