#pragma once

#include <string>

#include "scalar/mpfr.hpp"

namespace hbvm::core {

/// The fraction, or the number with one square root, that x is to so many digits: "-3544/2565", "(3 - sqrt(3))/6".
/// Empty if there is none whose whole numbers together have far fewer digits: a chance number has as many. Roots are
/// found whose equation has whole numbers up to 1000 before x^2, and up to 2000 before x.
std::string exact_form(const Mpfr& x, int digits);

}  // namespace hbvm::core
