#pragma once

#include <cmath>

namespace hbvm::core {

/// Digits that a run with steps h leaves right: order log10(reach / h) - lost. The error of a step of order p is
/// (h/reach)^p. For many stages this is the geometric convergence of the series of a step. The motion magnifies it by
/// 10^lost until the end.
struct ErrorModel {
  double order = 0;
  double log10_reach = 0;
  double lost = 0;

  double digits(double log10_step) const { return order * (log10_reach - log10_step) - lost; }
  /// log10 of the step that leaves so many.
  double log10_step(double digits) const { return log10_reach - (digits + lost) / order; }
  /// The same with the reach that one measured run shows.
  ErrorModel corrected(double log10_step, double digits) const {
    return {order, log10_step + (digits + lost) / order, lost};
  }
};

}  // namespace hbvm::core
