#pragma once

#include <fmt/format.h>

#include "scene/scene.hpp"

namespace hbvm::core::speed {

/// A planar chain of n rods of length 1/10, released from a straight line.
inline Scene chain(int n) {
  std::string text = "title = \"Chain\"\ndimension = 2\n[[point]]\nname = \"0\"\nposition = [0, 0]\n";
  for (int i = 1; i <= n; ++i)
    text += fmt::format(
        "[[body]]\nname = \"{0}\"\nmass = 1\nposition = [\"{0}*3/50\", \"-{0}*4/50\"]\nvelocity = [0, 0]\n", i);
  for (int i = 1; i <= n; ++i)
    text += fmt::format("[[constraint]]\nkind = \"rod\"\nbetween = [\"{}\", \"{}\"]\nlength = 0.1\n", i - 1, i);
  return read_scene(text + "[[effect]]\nkind = \"uniform_gravity\"\nacceleration = [0, -1]\n", "chain");
}

}  // namespace hbvm::core::speed
