#pragma once

#include <array>

#include "problem/force/force_arguments.hpp"

namespace hbvm::core {

/// A moment w on a rigid body: the force w x d/2 on each of its directors d. For orthonormal directors
/// sum d x (w x d) = 2 w. So the forces add up to w, and their power is w times the angular velocity. They depend on no
/// angle, however far the body has turned. In the plane w is across it, and d is turned by a right angle.
struct Torque {
  static constexpr std::string_view kind = "torque";
  static constexpr ForceOn on = ForceOn::rigid_body;
  static constexpr bool works = true;
  static constexpr std::array<ForceKey, 1> keys{{{"value", ForceKey::Components::axial}}};

  template <class T>
  static std::vector<T> F(const ForceArguments<T>& body) {
    return on_directors(body, moment(body), 0, body.x.size());
  }

  /// The value; with `along` that many times the vector with these components in the frame of the first body.
  template <class T>
  static std::vector<T> moment(const ForceArguments<T>& body) {
    const auto along = body.values.find("along");
    if (along == body.values.end()) return body.vector("value");
    std::vector<T> w = body.times(along->second[0], body.x[0]);
    for (std::size_t a = 1; a < along->second.size(); ++a)
      for (std::size_t j = 0; j < w.size(); ++j) w[j] = w[j] + along->second[a] * body.x[a][j];
    return body.times(body.number("value"), w);
  }

  /// w on the directors from `first` on.
  template <class T>
  static std::vector<T> on_directors(const ForceArguments<T>& body, const std::vector<T>& w, std::size_t first,
                                     std::size_t end) {
    std::vector<T> all;
    for (std::size_t a = first; a < end; ++a)
      for (const T& component : body.turned(w, body.x[a])) all.push_back(component / 2);
    return all;
  }
};

/// A motor between two rigid bodies: the moment on the first, and its opposite on the second.
struct MutualTorque {
  static constexpr std::string_view kind = "torque";
  static constexpr ForceOn on = ForceOn::rigid_bodies;
  static constexpr bool works = true;
  static constexpr std::array<ForceKey, 1> keys = Torque::keys;

  template <class T>
  static std::vector<T> F(const ForceArguments<T>& pair) {
    const std::size_t directors = pair.x.size() / 2;
    std::vector<T> w = Torque::moment(pair), opposite;
    for (const T& component : w) opposite.push_back(-component);
    std::vector<T> all = Torque::on_directors(pair, w, 0, directors);
    for (const T& component : Torque::on_directors(pair, opposite, directors, 2 * directors)) all.push_back(component);
    return all;
  }
};

}  // namespace hbvm::core
