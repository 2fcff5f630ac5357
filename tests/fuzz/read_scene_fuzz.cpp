// Any bytes are read as a scene or refused with an InputError of one line. A scene that was read is written and read
// back the same, and each of its numbers has a value or is refused.

#include <cstdint>
#include <cstdlib>
#include <iostream>

#include "hbvm/error.hpp"
#include "scene/scene.hpp"

namespace hbvm::core {
namespace {

void require(bool holds, const char* what, const std::string& text) {
  if (holds) return;
  std::cerr << what << ":\n" << text << '\n';
  std::abort();
}

/// Evaluates every number of a scene.
class Evaluation {
 public:
  explicit Evaluation(const Scene& scene) : constants_(scene.constants) {
    each(scene.constants);
    for (const ScenePoint& p : scene.points) each(p.position, p.charge);
    for (const SceneBody& b : scene.bodies) each(b.mass, b.mass_matrix, b.position, b.velocity, b.momentum, b.charge);
    for (const SceneRigidBody& b : scene.rigid_bodies)
      each(b.position, b.velocity, b.mass, b.center, b.second_moment, b.directors, b.angular_velocity);
    for (const SceneAttachment& a : scene.attachments) each(a.at, a.charge);
    for (const SceneConstraint& c : scene.constraints) each(c.numbers, c.vectors, c.matrices);
    for (const SceneEffect& e : scene.effects) each(e.numbers, e.vectors);
  }

 private:
  template <class... T>
  void each(const T&... parts) {
    (number(parts), ...);
  }
  template <class T>
  void number(const std::map<std::string, T, std::less<>>& values) {
    for (const auto& [name, value] : values) number(value);
  }
  template <class T>
  void number(const std::optional<T>& value) {
    if (value) number(*value);
  }
  template <class T>
  void number(const std::vector<T>& values) {
    for (const T& value : values) number(value);
  }
  void number(const Expression& e) {
    try {
      e.evaluate_to_bits(53, constants_);
    } catch (const ExpressionError&) {
    }
  }

  const Constants& constants_;
};

void read(const std::string& text) {
  Scene scene;
  try {
    scene = read_scene(text, "fuzz.toml");
  } catch (const InputError& error) {
    require(std::string(error.what()).find('\n') == std::string::npos, "a message of several lines", error.what());
    return;
  }
  const std::string written = write_scene(scene);
  try {
    require(write_scene(read_scene(written, "written.toml")) == written, "does not read back the same", written);
  } catch (const InputError& error) {
    require(false, error.what(), written);
  }
  Evaluation evaluation(scene);
}

}  // namespace
}  // namespace hbvm::core

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  hbvm::core::read(std::string(reinterpret_cast<const char*>(data), size));
  return 0;
}
