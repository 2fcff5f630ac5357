#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>

#include "hbvm/error.hpp"
#include "problem/constraint/common_point.hpp"
#include "problem/constraint/displacement_product.hpp"

namespace hbvm::core {

/// A hinge of two rigid bodies, or of one in space: a common point, and a common direction n, fixed in both. With unit
/// vectors e, f of the second that span the plane across its n, the latter is n.e = 0 and n.f = 0. These are two
/// independent g, whose multipliers are torques, where parallel vectors would be three dependent ones.
template <Scalar S>
struct Hinge {
  static constexpr std::string_view kind = "hinge";
  static constexpr std::array<ConstraintKey, 3> keys{{{"between", ConstraintKey::Takes::pair},
                                                      {"axis", ConstraintKey::Takes::vector},
                                                      {"second_axis", ConstraintKey::Takes::vector, true}}};
  static constexpr bool in_space_only = true;

  static ConstraintParts<CommonPoint<S>, DisplacementProduct<S>> from(const ConstraintInput<S>& input) {
    const auto& [first, second] = input.frames.find("between")->second;
    const Displacement<S>& x = input.pair("between");
    const Vector<S> axis = unit(input.vector("axis"), "axis");
    const Vector<S> n = input.has_vector("second_axis") ? unit(input.vector("second_axis"), "second_axis") : axis;
    ConstraintParts<CommonPoint<S>, DisplacementProduct<S>> parts;
    if (!x.blocks.empty())
      for (auto& [name, form] : CommonPoint<S>::of(x, 3)) parts.push_back({name, std::get<0>(form)});
    else if (x.shift.size() > 0)
      throw InputError("its points are fixed in space, and apart");
    int number = 0;
    for (const Vector<S>& across : plane_across(n))
      parts.push_back({"axis, " + std::to_string(++number),
                       DisplacementProduct<S>{first.direction(axis), second.direction(across), S(0)}});
    return parts;
  }

 private:
  static S product(const Vector<S>& a, const Vector<S>& b) {
    S sum = 0;
    for (Index i = 0; i < 3; ++i) sum += a[i] * b[i];
    return sum;
  }
  static Vector<S> unit(const Vector<S>& v, const std::string& key) {
    using std::sqrt;
    const S size = max_norm(v);
    if (size == 0) throw InputError("'" + key + "' is 0; a hinge turns about a direction");
    const Vector<S> scaled = v / size;  // so that no square leaves the range
    return scaled / S(sqrt(product(scaled, scaled)));
  }
  /// Two unit vectors across n and one another: what is left of the axis of space farthest from n, and n times it.
  static std::array<Vector<S>, 2> plane_across(const Vector<S>& n) {
    Index k = 0;
    for (Index i = 1; i < 3; ++i)
      if (magnitude(n[i]) < magnitude(n[k])) k = i;
    const Vector<S> e = unit(Vector<S>(Vector<S>::Unit(3, k) - n[k] * n), "axis");
    return {e, n.template head<3>().cross(e.template head<3>())};
  }
};

}  // namespace hbvm::core
