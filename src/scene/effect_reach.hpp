#pragma once

#include <string>
#include <utility>
#include <vector>

#include "scene/scene.hpp"

namespace hbvm::core {

/// The bodies, pairs or groups that an effect of a scene acts on, by their names, in the order of the instances of its
/// term.
struct EffectReach {
  std::vector<std::vector<std::string>> on;
  std::size_t effect = 0;  ///< its number among the effects of the scene, from 0
};

/// The bodies and rigid bodies that an effect does not act on, each with the reason: "not named".
std::vector<std::pair<std::string, std::string>> left_out(const Scene& scene, const SceneEffect& effect,
                                                          const EffectReach& reach);

/// "'a', 'b'" or "'a'-'b', 'a'-'c', and 98 more".
std::string to_text(const EffectReach& reach);

}  // namespace hbvm::core
