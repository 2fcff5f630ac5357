#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scheme/scheme.hpp"

namespace hbvm::core {

/// To how many digits the conditions of one order are met, the worst of them.
struct MetOrder {
  int order = 0;
  long conditions = 0;
  double digits = 0;  ///< -log10 of the greatest residual; that of the working precision if all are 0
  bool met = false;   ///< to what rounding of the numbers explains
};

/// What the conditions say of one set of weights.
struct MetPart {
  std::string name;
  std::optional<int> stated;
  int order = 0;               ///< all conditions up to it are met
  std::vector<MetOrder> each;  ///< from order 1 to the first that is not met, or to what is stated
};

/// The precision in which numbers are judged, and what rounding may have done to them.
struct Rounding {
  /// A number that is rounded, and digits that it has.
  struct Entry {
    std::size_t place = 0;
    int digits = 0;
  };

  int digits = 0;               ///< of the numbers' decimals; 0 if all are exact
  unsigned working_digits = 0;  ///< of the judgement
  std::vector<Entry> entries;
  bool of_fractions = false;  ///< fractions of many digits are rounded, too

  /// Decimals of a few digits less than the others have these alone. \param said the digits that the author says, also
  /// of fractions with many digits
  static Rounding of(const Scheme& scheme, std::optional<int> said);
  /// Whether there are fractions with so many digits that they may stand for other numbers.
  static bool has_long_fractions(const Scheme& scheme);
};

/// For each part of a scheme. The digits of the scope are those of the rounding, or more. A residual counts as 0 if
/// rounding explains it. Decimals that are off by a unit in their last digit make at least an eighth of it then.
std::vector<MetPart> met_parts(const Scheme& scheme, const std::vector<Mpfr>& values, const Rounding& rounding);

/// How many digits of what must hold at any order, as c = A 1; those of the working precision if there is nothing.
double consistent_digits(const Scheme& scheme, const std::vector<Mpfr>& values);

/// -log10 of the greatest of these, at most the digits of the scope.
double digits_met(const std::vector<Mpfr>& residuals);

}  // namespace hbvm::core
