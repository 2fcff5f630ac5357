#pragma once

#include "step/method.hpp"

namespace hbvm::core {

/// taylor: the motion by its Taylor series. Order and steps follow from the digits, so that all of these are right
/// whatever the step. The state at the end of a step is that of the series, in the digits of MPFR. A step is best as
/// long as the output allows: each begins its series anew. From no arguments; its steppers are made for MPFR alone,
/// others are refused with InputError. \throws InputError
MethodPtr taylor_method();

/// Makes parse_method() know it, as the program hbvm does before all else.
void add_taylor_method();

}  // namespace hbvm::core
