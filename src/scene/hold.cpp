#include "scene/hold.hpp"

#include <algorithm>

#include "hbvm/error.hpp"
#include "nearest.hpp"

namespace hbvm::core {
namespace {

std::vector<Index> range(Index first, Index count) {
  std::vector<Index> numbers;
  for (Index i = 0; i < count; ++i) numbers.push_back(first + i);
  return numbers;
}

/// All parts that can be held.
std::vector<HeldPart> parts_of(const Scene& scene) {
  std::vector<HeldPart> parts;
  const Index d = scene.dimension;
  Index offset = 0;
  const auto add_place = [&](const std::string& name, bool has_velocity) {
    parts.push_back({name + ".position", range(offset, d), {}});
    if (has_velocity) parts.push_back({name + ".velocity", {}, range(offset, d)});
    for (Index j = 0; j < d; ++j) {
      const char axis = "xyz"[j];
      parts.push_back({name + "." + axis, {offset + j}, {}});
      if (has_velocity) parts.push_back({name + ".v" + axis, {}, {offset + j}});
    }
    offset += d;
  };
  for (const SceneBody& body : scene.bodies) add_place(body.name, !body.velocity.empty());
  for (const SceneRigidBody& body : scene.rigid_bodies) {
    if (!body.fixed) add_place(body.name, true);
    parts.push_back({body.name + ".angle", range(offset, d * d), {}});
    parts.push_back({body.name + ".rate", {}, range(offset, d * d), body.name});
    offset += d * d;
  }
  return parts;
}

}  // namespace

std::vector<HeldPart> held_parts(const Scene& scene, const std::vector<std::string>& names) {
  const std::vector<HeldPart> all = parts_of(scene);
  std::vector<HeldPart> held;
  for (const std::string& name : names) {
    const auto found = std::find_if(all.begin(), all.end(), [&](const HeldPart& part) { return part.name == name; });
    if (found == all.end()) {
      std::vector<std::string> known;
      for (const HeldPart& part : all) known.push_back(part.name);
      const std::string meant = did_you_mean(name, known);
      throw InputError("'" + name + "' is nothing that can be held" +
                       (meant.empty() ? ": there are position, velocity, x, vx and so on of a body, and angle and rate "
                                        "of a rigid body, as crank.angle"
                                      : meant));
    }
    held.push_back(*found);
  }
  return held;
}

}  // namespace hbvm::core
