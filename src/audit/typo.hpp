#pragma once

#include <optional>
#include <string>

#include "method/runge_kutta.hpp"

namespace hbvm::core {

/// The one entry of a tableau that keeps it from a higher order.
struct Typo {
  std::string entry;     ///< "A[5][3]", from 1
  std::string written;   ///< about what it is
  std::string expected;  ///< and about what it should be
  int order = 0;         ///< that the method has then
};

/// Looks for an entry other than 0 that meets the conditions of the next order when changed alone. It must also meet at
/// least two that it was not changed for. None from order 6 on, where that takes long. \param order that the conditions
/// show to `digits`
std::optional<Typo> typo_of(const Tableau& tableau, int order, int digits);

/// Whether the conditions of the next order are likely to be meant. They are if met much better than a method of this
/// order meets them by itself. Gauss's methods come nearest: they miss one condition by 1/binom(p, p/2) of it.
bool is_nearly_of_next_order(const Tableau& tableau, int order);

}  // namespace hbvm::core
