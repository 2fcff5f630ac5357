#pragma once

#include <type_traits>
#include <vector>

#include "hbvm/linear/matrix.hpp"
#include "hbvm/linear/operation_counts.hpp"
#include "hbvm/scalar/in_place.hpp"

namespace hbvm {

/// Positions (or velocities, forces …) of all coordinates in several lanes, a lane being one node of a quadrature:
/// coordinate j of lane i is data[j * count + i]. A matrix with a row a lane has this layout, and so has one vector,
/// with a single lane.
template <class T>
struct Lanes {
  T* data;
  Index count;
  T* operator[](Index coordinate) const { return data + coordinate * count; }
  operator Lanes<const T>() const requires(!std::is_const_v<T>) { return {data, count}; }
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

/// A vector in space made of coordinate blocks: sum_i weight_i q[offset_i .. offset_i + d) + shift. A body's position
/// is one block; a displacement two, or a block and minus a fixed point; a rigid body's centre four.
template <Scalar S>
struct Displacement {
  struct Block {
    Index offset;
    S weight;
  };
  std::vector<Block> blocks;
  Vector<S> shift;  ///< d entries, or none for 0
};

/// r_i += weight a_i for i < count, which for the usual weights 1 and -1 is an addition each; `t` is scratch.
template <Scalar S>
void add_weighted(S* r, const S& weight, const S* a, Index count, S& t) {
  if (weight == 1)
    for (Index i = 0; i < count; ++i) set_sum(r[i], r[i], a[i]);
  else if (weight == -1)
    for (Index i = 0; i < count; ++i) set_difference(r[i], r[i], a[i]);
  else
    for (Index i = 0; i < count; ++i) add_product(r[i], weight, a[i], t);
}

/// The operations of add_weighted for n numbers.
template <Scalar S>
OperationCounts weighted_sum(const S& weight, Index n) {
  OperationCounts counts;
  counts.add(weight == -1 ? Op::subtract : Op::add, n);
  if (weight != 1 && weight != -1) counts.add(Op::multiply, n);
  return counts;
}

/// The operations of one displacement in one lane.
template <Scalar S>
OperationCounts operations(const Displacement<S>& x, Index dimension) {
  OperationCounts counts;
  for (std::size_t b = 0; b < x.blocks.size(); ++b) {
    if (b > 0)
      counts += weighted_sum(x.blocks[b].weight, dimension);
    else if (x.blocks[b].weight != 1)
      counts.add(Op::multiply, dimension);
  }
  if (x.shift.size() > 0) counts.add(Op::add, dimension);
  return counts;
}

/// The displacement at q: component j of lane i goes to out[j * stride + i].
template <Scalar S>
void displace(const Displacement<S>& x, Index dimension, Lanes<const S> q, S* out, Index stride);

#define HBVM_DECLARE(S) extern template void displace<S>(const Displacement<S>&, Index, Lanes<const S>, S*, Index);
HBVM_FOR_EACH_SCALAR(HBVM_DECLARE)
#undef HBVM_DECLARE

}  // namespace hbvm
