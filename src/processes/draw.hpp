#pragma once

#include <vector>

#include "hbvm/figure.hpp"

namespace hbvm::core {

/// Draws the figure into a file by gnuplot. \throws InputError for an ending other than .svg, .pdf and .png; Error if
/// gnuplot is missing or fails, with the name of its package
void draw(const Figure& figure, const std::string& file);
/// Draws pictures one after another into a .gif that repeats. \throws likewise
void draw_frames(const std::vector<Figure>& frames, int a_second, const std::string& file);

}  // namespace hbvm::core
