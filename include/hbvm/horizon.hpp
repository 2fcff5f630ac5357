#pragma once

#include <optional>
#include <string>
#include <vector>

namespace hbvm {

/// When a precision has no right digit left of a start that it rounds.
struct Horizon {
  std::string precision;
  double digits = 0;
  std::optional<double> t = {};  ///< none if changes do not grow so far
  bool extrapolated = false;     ///< beyond the time that was looked at, at the rate of its end
};

/// How long the digits of a start last. An error of the start, or of rounding there, grows by 10^lost until each time.
struct DigitsLost {
  std::vector<double> times, lost;   ///< at equal distances; lost never falls
  std::vector<Horizon> horizons;     ///< of double, 34 digits, and the precision of a run
  std::optional<double> measured_t;  ///< when no digit of the run was left, beside its shadow; none if some stayed
  std::string failure;               ///< why it is not known, if it is not
};

}  // namespace hbvm
