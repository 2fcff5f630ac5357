#pragma once

#include <string>

#include "hbvm/results.hpp"

namespace hbvm::core {

/// What `hbvm reference --against` found as a page of HTML that needs nothing besides itself: the verdict, curves of
/// digits, and tables of them.
/// \param scene its name \param command what makes the page again
/// \throws Error without gnuplot, which draws the curves
std::string comparison_page(const Comparison& against, const std::string& scene, const std::string& command);

}  // namespace hbvm::core
