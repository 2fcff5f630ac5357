#pragma once

#include "hbvm/figure.hpp"

namespace hbvm::core {

/// Draws the figure into a file by gnuplot. \throws InputError for an ending other than .svg, .pdf and .png; Error if
/// gnuplot is missing or fails, with the name of its package
void draw(const Figure& figure, const std::string& file);

}  // namespace hbvm::core
