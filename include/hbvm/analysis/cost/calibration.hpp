#pragma once

#include "hbvm/scalar/precision.hpp"

namespace hbvm {

/// Processor time, in seconds, of a fixed count of products and sums in a precision: some milliseconds on an idle
/// machine. Measured beside a run it shows what else the machine was doing.
double calibration_seconds(const Precision& precision);

/// Typical nanoseconds of an operation, from double to many digits: to plan with, never to measure with.
double typical_nanoseconds(const Precision& precision);

}  // namespace hbvm
