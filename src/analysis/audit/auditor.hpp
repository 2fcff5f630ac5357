#pragma once

#include <optional>

#include "cell.hpp"
#include "hbvm/analysis/audit/audit.hpp"
#include "hbvm/scalar/precision.hpp"

namespace hbvm {

/// Decides the claims of one unit of work; the findings go to the claims' places.
class Auditor {
 public:
  enum class Kind { step, interval, round_off, tableau, special };
  static Kind kind_of(const Claim& claim);

  /// Claims of one kind about one method on one problem: what one series of runs decides.
  struct Unit {
    Kind kind;
    std::vector<std::size_t> members;  ///< places of the claims
  };

  Auditor(const std::vector<Claim>& claims, const Unit& unit, const AuditOptions& options,
          std::vector<Finding>& findings);

  /// \throws InputError, IntegrationError
  void work();

 private:
  Finding& finding(std::size_t c) { return findings_[unit_.members[c]]; }
  std::string reference() const;

  void follow_steps();
  void follow_intervals();
  void conserve();
  void check_tableau();
  void measure_special();

  /// Raises the precision, over at least so many levels, until every claim is decided.
  template <class Measure>
  void climb(std::size_t at_least, const Measure& measure);
  unsigned least_digits() const;
  /// Whether more digits could not change a verdict.
  bool none_is_open(const Ladders& ladders);
  void take(Finding& f, const std::vector<Rung>& rungs, const Precision& precision);
  /// An error over an interval falls no faster than that of its first step, which can be followed far deeper: to where
  /// a wrong 25th digit of a coefficient takes over.
  void compare_with_one_step();
  /// The worst of all precisions counts.
  void settle(std::size_t c, const Precision& precision, std::optional<double> units, const std::string& reason,
              double allowed = 0);

  Cell cell_;
  const Unit& unit_;
  const AuditOptions& options_;
  std::vector<Finding>& findings_;
};

}  // namespace hbvm
