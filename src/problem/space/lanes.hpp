#pragma once

#include <type_traits>

#include "linear/matrix.hpp"

namespace hbvm::core {

/// Positions (or velocities, forces …) of all coordinates in several lanes. A lane is one node of a quadrature.
/// Coordinate j of lane i is data[j * count + i]. A matrix with a row a lane has this layout, and so has one vector,
/// with a single lane. Their number may be a constant of type Count (with_constant_count).
template <class T, class Count = Index>
struct Lanes {
  T* data;
  Count count;
  T* operator[](Index coordinate) const { return data + coordinate * count; }
  operator Lanes<const T, Count>() const requires(!std::is_const_v<T>) { return {data, count}; }
};

template <class Array>
Lanes<const typename Array::Scalar> lanes(const Eigen::PlainObjectBase<Array>& x) {
  return {x.data(), Array::ColsAtCompileTime == 1 ? 1 : x.rows()};
}
template <class Array>
Lanes<typename Array::Scalar> lanes(Eigen::PlainObjectBase<Array>& x) {
  return {x.data(), Array::ColsAtCompileTime == 1 ? 1 : x.rows()};
}

}  // namespace hbvm::core
