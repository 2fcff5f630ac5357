#pragma once

#include <optional>
#include <stop_token>
#include <string>
#include <vector>

namespace hbvm {

/// Coefficients of a method, in a file, to be held against their order conditions.
///
/// Files are TOML or JSON with arrays of numbers, or printed Butcher tableaux. Numbers are decimals, fractions or
/// expressions as "sqrt(3)/6"; "?" stands for one that is not known. Families are told by their arrays, or by `family`:
///
///     runge_kutta   A, b; c, b_hat, b_theta        partitioned   A, b, A_hat, b_hat
///     nystrom       c, A, b, b_hat; A_hat          rosenbrock    alpha, gamma, b; b_hat
///     splitting     a, b                           composition   gamma; or alpha, beta
///     multistep     alpha, beta
struct SchemeRequest {
  std::string file;
  std::optional<int> order = {};           ///< that is claimed, in place of what the file states
  std::optional<int> embedded_order = {};  ///< likewise
  int most_mended = 2;                     ///< entries that a repair may change: 0, 1 or 2
  std::stop_token stop = {};
};

/// The order of one set of weights.
struct SchemeOrder {
  std::string name;           ///< "order", "embedded order"
  std::optional<int> stated;  ///< that is claimed
  int order = 0;              ///< whose conditions are met, and those of all below it
  double digits = 0;          ///< to which they are met; all that were computed if they are met exactly
  double next_digits = 0;     ///< to which those of the next order are met; 0 if they are not known
  bool holds = false;         ///< the claim; without one, that no single entry keeps the method from a higher order
};

/// An entry that is mended.
struct MendedNumber {
  std::string entry;    ///< "A[6][3]", from 1
  std::string printed;  ///< as the file has it: a number, or "?"
  std::string value;    ///< what it should be, in decimals
  std::string exact;    ///< the fraction or square root that this is; empty if it is none
};

struct SchemeAudit {
  std::string file, name, family;
  int entries = 0;
  int digits = 0;  ///< of decimals that are rounded; 0 if the numbers are exact
  /// Digits to which c are the row sums of A, or what is to hold at any order does; nothing if there is no c.
  std::optional<double> rows;
  bool consistent = true;  ///< that holds to all digits that the numbers have; or the next
  /// c are not the row sums, and the order is that of y' = f(t, y) all the same, as of some methods of Lobatto.
  bool own_nodes = false;
  bool rounded_fractions = false;  ///< fractions with many digits stand for other numbers
  std::vector<SchemeOrder> orders;
  std::vector<std::string> facts;    ///< "explicit", "first same as last", "R(inf) = 0", with their digits
  std::vector<MendedNumber> repair;  ///< empty if nothing fails, or if the conditions do not determine it
  long conditions = 0;               ///< that hold when it is mended
  std::string repair_says;           ///< of a repair or why there is none; empty if nothing fails
  std::string mended;                ///< the file's scheme in TOML, mended; empty without a repair
  bool holds = false;
};

/// \throws InputError with the file and what is wrong; Interrupted
SchemeAudit audit_scheme(const SchemeRequest& request);

/// What a reader wants first: orders with their digits, facts, and the repair.
std::string to_text(const SchemeAudit& audit);
/// One line for a job that checks.
std::string to_line(const SchemeAudit& audit);
std::string to_json(const SchemeAudit& audit);
/// XML of JUnit, for services that run tests: a case for each order.
std::string to_junit(const SchemeAudit& audit);

}  // namespace hbvm
