#pragma once

#include <string>

#include "scalar/scalar.hpp"

namespace hbvm::core {

/// The shortest decimal text that reads back as the same number of the same precision ("0.1", "1.5e-60", "nan").
std::string to_text(double x);
std::string to_text(const Quad& x);
std::string to_text(const Mpfr& x);

/// `digits` significant digits, correctly rounded, in the form d.ddde±xx of C's %e. For tables and messages.
std::string to_scientific(double x, int digits);
std::string to_scientific(const Quad& x, int digits);
std::string to_scientific(const Mpfr& x, int digits);
/// The same of a number that is a text already, of any length.
std::string to_scientific(const std::string& decimal, int digits);

/// Whether it is a decimal: a sign -, digits with at most one point, and an exponent.
bool is_decimal(const std::string& text);

/// A decimal rounded to so many significant digits, trailing zeros kept: "0.1230", "-12.5"; with an exponent where
/// there would be more zeros than digits.
std::string rounded_text(const std::string& decimal, int digits);

}  // namespace hbvm::core
