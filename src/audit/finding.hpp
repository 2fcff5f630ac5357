#pragma once

#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "audit/claim.hpp"
#include "audit/convergence.hpp"

namespace hbvm::core {

enum class Verdict {
  holds,
  fails,
  undecidable,  ///< neither, with the digits and the time there are
  degenerate,   ///< so it is, but for any method: the motion is too special
  not_run       ///< nothing could be measured
};
std::string_view name_of(Verdict verdict);

/// The errors of a quantity in one precision.
struct Ladder {
  std::string precision;
  std::vector<Rung> rungs;
};

/// Of time, in the scene's units.
struct Interval {
  double from = 0, to = 0;
};

/// What the audit found out about a claim.
struct Finding {
  Claim claim;
  Verdict verdict = Verdict::undecidable;
  double measured = 0, uncertainty = 0;  ///< rate, NaN if there is only round-off; of Form::round_off, units of
                                         ///< round-off in every step and how many are allowed
  std::string precision;                 ///< the greatest in which errors entered the verdict
  std::string reference;                 ///< what errors are measured against
  std::string reason;                    ///< of the verdict; of one that "holds", what proves it, if anything does
  std::optional<Interval> interval{};    ///< looked at; none of coefficients
  int coefficients_to = 0;               ///< digits to which the coefficients were seen to be right; 0: not looked at
  /// Processor time of the runs that this claim shared with others; NaN of what was known from before.
  double seconds = std::numeric_limits<double>::quiet_NaN();
  std::vector<Ladder> evidence;  ///< precision after precision
};

/// Whether a measured rate bears a claim out. The claim fails if the interval value +- uncertainty excludes the
/// predicted rate (for `at_least`: lies below it). A claim `at_least` holds if the interval lies above that rate. The
/// exponents of an expansion in h are whole numbers. So a claim also holds if the predicted rate is whole and in the
/// interval, and that is less than a half wide.
Verdict judge(const Claim& claim, const std::optional<Rate>& rate);

}  // namespace hbvm::core
