#pragma once

#include "method/hbvm.hpp"
#include "scalar/precision.hpp"
#include "scene/assemble.hpp"

namespace hbvm::core {

/// A fixed count of steps of HBVM(2,2) on three tethered satellites in the working precision: some milliseconds on an
/// idle machine. Measured beside a run it shows what else the machine was doing. It is the solver's own code, with as
/// many instructions and as much memory, and so is slowed down by what slows down runs. (A loop of products and sums is
/// not: where a run took 1.6 times as long, it took 1.08.)
template <Scalar S>
class Calibration {
 public:
  /// \param precision that of S
  explicit Calibration(const Precision& precision);
  /// Processor time of the steps.
  double seconds() const;

 private:
  Assembled<S> scene_;
  Hbvm<S> method_;
  long steps_;
};

/// Typical nanoseconds of an operation, from double to many digits: to plan with, never to measure with.
double typical_nanoseconds(const Precision& precision);

}  // namespace hbvm::core
