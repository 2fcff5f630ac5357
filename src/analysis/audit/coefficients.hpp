#pragma once

#include <vector>

#include "hbvm/analysis/audit/claim.hpp"
#include "hbvm/method/runge_kutta.hpp"

namespace hbvm {

/// To how many decimal digits the coefficients of a method meet the conditions they should, as seen in `digits` of
/// them.
class CoefficientCheck {
 public:
  /// Whether there is something to look at.
  static bool is_for(const Method& method);
  /// \throws InputError for coefficients without a value
  CoefficientCheck(const Claim& subject, int digits);

  int digits() const { return digits_; }
  /// Of HBVM(k, s), B(2k), C(s), D, X_s, W and symmetry.
  int definition() const { return definition_; }
  /// Of a tableau, all conditions up to an order: of the rooted trees to max_tree_order, beyond that B, C and D by
  /// Butcher's theorem.
  int order(int p) const;
  /// The order that its conditions show to so many digits.
  int order_to(int digits) const;
  int symplecticity() const { return symplecticity_; }
  int symmetry() const { return symmetry_; }
  int row_sums() const { return C_.empty() ? digits_ : C_.front(); }

 private:
  void look_at(const Tableau& tableau);
  int decimals(double log2_defect) const;
  int digits_;
  int definition_ = 0, symplecticity_ = 0, symmetry_ = 0;
  std::vector<int> trees_, B_, C_, D_;  ///< of orders, and powers, 1, 2, ...: all up to there
};

}  // namespace hbvm
