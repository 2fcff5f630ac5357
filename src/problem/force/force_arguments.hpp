#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace hbvm::core {

/// What a force acts on.
enum class ForceOn {
  each_body,     ///< x is the position of a body, or of the centre of mass of a rigid body
  charged_body,  ///< likewise, of each body that has a charge
  pair,          ///< x = a - b for every pair of `between`
  rigid_body,    ///< x are the directors of a rigid body
  rigid_bodies,  ///< x are the directors of two
  inertia        ///< x are the position of a body, or the reference point and directors of a rigid one
};

/// A key of an [[effect]] that is a force. Its value is a formula, or one for each component.
struct ForceKey {
  enum class Components {
    one,    ///< a number
    space,  ///< d of them
    axial   ///< in space 3, in the plane 1: a moment, an angular velocity, a magnetic field
  };
  std::string_view name;
  Components components = Components::one;
  std::string_view fallback = {};  ///< each component if the key is absent; empty: the key is required
  bool local = false;              ///< the formula may name positions, velocities, m and Q of the body, and not t alone
};

/// What the formula of a force may use, over any number type T with + - * / and sqrt.
template <class T>
struct ForceArguments {
  std::vector<std::vector<T>> x, v;                           ///< displacements that it acts on, and their velocities
  std::map<std::string, std::vector<T>, std::less<>> values;  ///< of its keys, component by component
  std::set<std::string, std::less<>> zeros;                   ///< the keys all of whose components are written as 0
  std::vector<T> parameters;                                  ///< of an instance, such as its charge or its inertia

  const T& number(std::string_view key) const { return values.find(key)->second.front(); }
  const std::vector<T>& vector(std::string_view key) const { return values.find(key)->second; }
  bool is_zero(std::string_view key) const { return zeros.contains(key); }

  static T dot(const std::vector<T>& a, const std::vector<T>& b) {
    T sum = a[0] * b[0];
    for (std::size_t i = 1; i < a.size(); ++i) sum = sum + a[i] * b[i];
    return sum;
  }
  static std::vector<T> times(const T& factor, std::vector<T> a) {
    for (T& component : a) component = factor * component;
    return a;
  }
  /// w x a; in the plane w has the one component across it.
  static std::vector<T> turned(const std::vector<T>& w, const std::vector<T>& a) {
    if (w.size() == 1) return {-(w[0] * a[1]), w[0] * a[0]};
    const auto component = [&](std::size_t i, std::size_t j) {
      const T taken = w[j] * a[i];
      return w[i] * a[j] - taken;
    };
    return {component(1, 2), component(2, 0), component(0, 1)};
  }
};

}  // namespace hbvm::core
