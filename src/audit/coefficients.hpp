#pragma once

#include <optional>
#include <vector>

#include "audit/claim.hpp"
#include "method/decimals.hpp"
#include "method/runge_kutta.hpp"

namespace hbvm::core {

/// To how many decimal digits a condition is met, and to how many it must be. All digits that are looked at are due.
/// Where the numbers of a tableau are decimals, only those are due that a unit in their last digit leaves.
struct Met {
  int seen = 0, due = 0;
  bool holds() const { return seen >= due; }
};

/// What is known of each condition on a tableau; of those of orders and powers, 1, 2, ..., of all up to there.
template <class T>
struct EachCondition {
  std::vector<T> trees, B, C, D;
  T symplecticity{}, symmetry{};
};

/// How far the coefficients of a method meet the conditions they should, as seen in `digits` of them.
class CoefficientCheck {
 public:
  /// Whether there is something to look at.
  static bool is_for(const Method& method);
  /// \throws InputError for coefficients without a value
  CoefficientCheck(const Claim& subject, int digits);

  /// Of a tableau with decimals no more than these can show.
  int digits() const { return digits_; }
  const std::optional<Decimals>& decimals() const { return decimals_; }
  /// Of HBVM(k, s), B(2k), C(s), D, X_s, W and symmetry.
  int definition() const { return definition_; }
  /// Of a tableau, all conditions up to an order: of the rooted trees to deciding_tree_order, beyond that B, C and D by
  /// Butcher's theorem.
  Met order(int p) const;
  /// The order that its conditions show to so many digits, and the one that they show.
  int order_to(int digits) const;
  int order_found() const;
  /// The greatest p, q and r of conditions B(p), C(q) and D(r) that are met.
  int B_found() const { return found(seen_.B, due_.B); }
  int C_found() const { return found(seen_.C, due_.C); }
  int D_found() const { return found(seen_.D, due_.D); }
  Met symplecticity() const { return {seen_.symplecticity, due_.symplecticity}; }
  Met symmetry() const { return {seen_.symmetry, due_.symmetry}; }
  Met row_sums() const { return {seen_.C.front(), due_.C.front()}; }

 private:
  void look_at(const Tableau& tableau);
  int decimal_digits(double log2_defect) const;
  int order_by_parts(const EachCondition<int>& digits, int p) const;
  static int found(const std::vector<int>& seen, const std::vector<int>& due);

  int digits_;
  std::optional<Decimals> decimals_;
  int definition_ = 0;
  EachCondition<int> seen_, due_;  ///< digits
};

}  // namespace hbvm::core
