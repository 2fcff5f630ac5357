#pragma once

#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace hbvm::core {

/// What starts of a section differ by: a name, and the values that it takes, as exact text.
struct StartAxis {
  std::string name;
  std::vector<Expression> values;
};

/// "y=-3/10:6/10:12" are twelve values at equal distances, "y=0.1,0.2" are two.
/// \throws InputError
StartAxis parse_start_axis(const std::string& text);

/// One start: a value for each name, and the scene that has it.
struct SectionStart {
  std::vector<std::string> values;
  Scene scene;
};

/// All combinations, the last name's values one after another first. \throws InputError for names that the scene has
/// not, names given twice, and for more than ten thousand
std::vector<SectionStart> starts_of(const Scene& scene, const std::vector<StartAxis>& axes);

}  // namespace hbvm::core
