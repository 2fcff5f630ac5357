#pragma once

#include "hbvm/method.hpp"

namespace hbvm::core {

/// What hbvm::read_tableau() reads is a TOML file:
///
///     name = "Gauss, two stages"   # that of the file if absent
///     order = 4                    # claimed; optional
///     digits = 30                  # of its decimals, if they are rounded; see decimals_of for what is taken if absent
///     A = [["1/4", "1/4-sqrt(3)/6"], ["1/4+sqrt(3)/6", "1/4"]]
///     b = [0.5, 0.5]
///     c = ["1/2-sqrt(3)/6", "1/2+sqrt(3)/6"]   # the row sums of A if absent
///
/// Entries are whole numbers, decimals, which are read exactly, or expressions in quotes.
/// \throws InputError with file, line and what is wrong: a key that is missing or unknown, A that is not square, b or c
///         of another length, no stages or more than max_tableau_stages, an entry without a value
inline constexpr std::size_t max_tableau_stages = 100;
inline constexpr long max_tableau_digits = 10'000;

}  // namespace hbvm::core
