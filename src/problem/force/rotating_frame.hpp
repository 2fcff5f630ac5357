#pragma once

#include <array>

#include "problem/force/force_arguments.hpp"

namespace hbvm::core {

/// The scene in a frame that turns with the constant angular velocity omega about the center. This is its Coriolis
/// force, f_i = -2 sum_j m_ij omega x v_j, which does no work. The centrifugal force has the potential
///
///     U = 1/2 sum_ij m_ij (omega x x_i).(omega x x_j).
///
/// Both are of all the mass of a body. The x_i of a rigid body are its reference point, from the center, and its
/// directors, with the m_ij of its mass matrix. The energy is that in the turning frame.
struct RotatingFrame {
  static constexpr std::string_view kind = "rotating_frame";
  static constexpr ForceOn on = ForceOn::inertia;
  static constexpr bool works = false;
  static constexpr std::array<ForceKey, 2> keys{
      {{"omega", ForceKey::Components::axial}, {"center", ForceKey::Components::space, "0"}}};

  template <class T>
  static std::vector<T> F(const ForceArguments<T>& body) {
    std::vector<T> all;
    const std::size_t parts = body.x.size();
    for (std::size_t i = 0; i < parts; ++i) {
      std::vector<T> sum;
      for (std::size_t j = 0; j < parts; ++j) {
        const std::vector<T> part = body.times(body.parameters[i * parts + j], body.v[j]);
        for (std::size_t l = 0; l < part.size(); ++l)
          if (j == 0)
            sum.push_back(part[l]);
          else
            sum[l] = sum[l] + part[l];
      }
      for (const T& component : body.turned(body.vector("omega"), sum)) all.push_back(-2 * component);
    }
    return all;
  }

  template <class T>
  static T U(const ForceArguments<T>& body) {
    const std::size_t parts = body.x.size();
    std::vector<std::vector<T>> turned;
    for (std::size_t i = 0; i < parts; ++i) {
      std::vector<T> x = body.x[i];
      // Directors are no places.
      for (std::size_t l = 0; i == 0 && l < x.size(); ++l) x[l] = x[l] - body.vector("center")[l];
      turned.push_back(body.turned(body.vector("omega"), x));
    }
    T sum = body.parameters[0] * body.dot(turned[0], turned[0]);
    for (std::size_t i = 0; i < parts; ++i)
      for (std::size_t j = 0; j < parts; ++j)
        if (i + j > 0) sum = sum + body.parameters[i * parts + j] * body.dot(turned[i], turned[j]);
    return sum / 2;
  }
};

}  // namespace hbvm::core
