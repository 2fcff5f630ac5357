#pragma once

#include "step/method.hpp"

namespace hbvm::core {

// Methods of Boost.odeint, on the index-reduced equations, each a ReducedStepper: they keep neither the constraints nor
// the energy, and lose both at their order.

/// rkf78: the method of order 8 of Fehlberg's pair of orders 7 and 8, with 13 stages: runge_kutta_fehlberg78 of
/// Boost.odeint. Its steps are those of the grid, none is refused. From no arguments. \throws InputError
MethodPtr rkf78_method();

/// bulirsch_stoer:DIGITS: extrapolation of the modified midpoint rule, of orders up to 16: bulirsch_stoer of
/// Boost.odeint. Within each step of the grid it chooses its own, until the error it estimates in one is below
/// 10^-DIGITS of a size. That size is the change of each body's positions and momenta in the step, or their magnitude
/// if that is more. From "DIGITS". \throws InputError
MethodPtr bulirsch_stoer_method(std::string_view arguments);

}  // namespace hbvm::core
