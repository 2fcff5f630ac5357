#pragma once

#include <string>
#include <vector>

#include "scene/varied_scene.hpp"

namespace hbvm::core {

/// What starts of a section differ by: "y=-3/10:6/10:12" are twelve values at equal distances, "y=0.1,0.2" are two.
/// \throws InputError
VariedNumber parse_starts(const std::string& text);

/// All combinations. \throws InputError for names that the scene has not, names given twice, and for more than ten
/// thousand
std::vector<VariedScene> starts_of(const Scene& scene, const std::vector<VariedNumber>& numbers);

}  // namespace hbvm::core
