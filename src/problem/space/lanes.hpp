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

template <Scalar S>
Lanes<const S> lanes(const Matrix<S>& rows) {
  return {rows.data(), rows.rows()};
}
template <Scalar S>
Lanes<const S> lanes(const Vector<S>& one) {
  return {one.data(), 1};
}
template <Scalar S>
Lanes<S> lanes(Matrix<S>& rows) {
  return {rows.data(), rows.rows()};
}
template <Scalar S>
Lanes<S> lanes(Vector<S>& one) {
  return {one.data(), 1};
}

}  // namespace hbvm::core
