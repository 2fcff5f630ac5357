#pragma once

#include <string>
#include <vector>

#include "scheme/met_orders.hpp"

namespace hbvm::core {

/// What else the numbers of a scheme show, each with the digits to which it was seen. Runge-Kutta methods: explicit,
/// first same as last, stiffly accurate, symplectic, symmetric. Their stability: the interval, or R at infinity and
/// A-stability, algebraic stability, the SSP coefficient. The norm of the next order's errors. Multistep methods:
/// zero-stable, and the error constant. Splittings and compositions: symmetric. \param order that the conditions show
std::vector<std::string> facts_of(const Scheme& scheme, const std::vector<Mpfr>& values, const Rounding& rounding,
                                  int order);

}  // namespace hbvm::core
