#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "hbvm/error.hpp"
#include "linear/matrix.hpp"

namespace hbvm::core {

/// The unit vector along an axis of a joint.
/// \param key where it was given
template <Scalar S>
Vector<S> unit_axis(const Vector<S>& v, const std::string& key) {
  using std::sqrt;
  const S size = max_norm(v);
  if (size == 0) throw InputError("'" + key + "' is 0; the axis of a joint is a direction");
  const Vector<S> scaled = v / size;  // so that no square leaves the range
  S square = 0;
  for (Index i = 0; i < scaled.size(); ++i) square += scaled[i] * scaled[i];
  return scaled / S(sqrt(square));
}

/// Unit vectors across a unit vector n. In the plane it is n turned to the left. In space they are e and f = n x e. Of
/// the axis with the least component along n, the first of several, e is along the part across n.
template <Scalar S>
std::vector<Vector<S>> across(const Vector<S>& n) {
  if (n.size() == 2) return {Vector<S>{{S(-n[1]), n[0]}}};
  Index k = 0;
  for (Index i = 1; i < 3; ++i)
    if (magnitude(n[i]) < magnitude(n[k])) k = i;
  const Vector<S> e = unit_axis(Vector<S>(Vector<S>::Unit(3, k) - n[k] * n), "axis");
  return {e, n.template head<3>().cross(e.template head<3>())};
}

}  // namespace hbvm::core
