#pragma once

#include <optional>
#include <string>
#include <vector>

namespace hbvm {

/// A rate lies within value +- uncertainty, as the audit's judge has it from the slopes of five steps or more.
struct MeasuredRate {
  double value = 0, uncertainty = 0;
};

/// An error at one step, of a ladder of steps that a program of one's own has made. All are binary logarithms, for
/// which no precision is too high.
struct StepError {
  double step = 0;   ///< log2 of the step
  double error = 0;  ///< log2 of the error
  double floor = 0;  ///< log2 of what round-off explains of it; an error that is not above is left out
};

/// The rate that errors tend to. \param ladder from coarse to fine
/// \return nothing if there are no five errors in a row above their floors, with at least four halvings between them
std::optional<MeasuredRate> measured_rate(const std::vector<StepError>& ladder);

/// Whether a rate shows an order, or a higher one: "holds", "fails" or "undecidable".
std::string order_verdict(const std::optional<MeasuredRate>& rate, double order);

}  // namespace hbvm
