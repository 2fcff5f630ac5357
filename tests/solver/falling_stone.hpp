#pragma once

#include <string>

#include "scene/scene.hpp"

namespace hbvm::core {

/// A body at rest so far from a centre of gravity. From 1 it would reach it at t = pi/sqrt(8) = 1.11.
inline Scene falling_stone(const std::string& distance) {
  return read_scene(
      "dimension = 2\npoint = [{ name = \"sun\", position = [0, 0] }]\n"
      "body = [{ name = \"stone\", mass = 1, position = [" +
          distance +
          ", 0], velocity = [0, 0] }]\n"
          "effect = [{ kind = \"central_gravity\", center = \"sun\", strength = 1 }]\n",
      "fall");
}

}  // namespace hbvm::core
