#pragma once

#include <optional>
#include <string>
#include <vector>

#include "method/runge_kutta.hpp"

namespace hbvm::core {

/// What is known of the numbers of a tableau that are decimals, and not exact.
struct Decimals {
  int digits = 0;                         ///< that they have; they may be off by a unit in the last
  std::string example;                    ///< one of them, as it is written
  std::optional<std::string> fraction{};  ///< of small numbers, which the example is when rounded
};

/// The decimals of a tableau, with the digits that its author says. If none are said: decimals of eight digits or more
/// are taken for rounded, unless they are whole multiples of 2^-30. The digits are the median of those that have a
/// value from 1/10 to 1, if any have, and 16 for what a double prints. None if nothing is rounded.
std::optional<Decimals> decimals_of(const Tableau& tableau);
/// The same of any numbers. \param said the digits that their author says
std::optional<Decimals> decimals_of(const std::vector<std::string>& numbers, std::optional<int> said);
/// Whether a number is written with a decimal in it.
bool has_decimal(const std::string& number);

/// The coefficients with every decimal off by a unit in its last digit, up or down by `pattern`. Numbers below 1 have
/// as many places.
RungeKutta<Mpfr> off_by_a_unit(const Tableau& tableau, const Decimals& decimals, unsigned pattern);

}  // namespace hbvm::core
