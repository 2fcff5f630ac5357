#pragma once

#include "scene/scene.hpp"

namespace hbvm::core {

/// One more event. \param direction "up", "down", or "" for any \throws InputError
void add_event(Scene& scene, const std::string& name, const std::string& value, const std::string& direction,
               std::size_t line = 0);

/// The scene whose observations are its events, for what evaluates formulas along a motion.
Scene with_events_observed(const Scene& scene);

/// The scene with one more, as a command writes it: "NAME: value", "NAME up: value". The scene remembers the change as
/// with_number() does. \throws InputError
Scene with_event(const Scene& scene, const std::string& text);

}  // namespace hbvm::core
