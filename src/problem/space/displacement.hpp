#pragma once

#include <algorithm>
#include <set>
#include <vector>

#include "linear/in_double.hpp"
#include "linear/operation_counts.hpp"
#include "problem/space/lanes.hpp"
#include "scalar/in_place.hpp"

namespace hbvm::core {

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

/// How many axes there are to turn about in space of dimension d: 0, 1 or 3.
inline Index rotations_in(Index d) { return d * (d - 1) / 2; }

/// Whether it leads from one position to another: one block less another.
template <Scalar S>
bool is_pair(const Displacement<S>& x) {
  return x.blocks.size() == 2 && x.shift.size() == 0 && x.blocks[0].weight == 1 && x.blocks[1].weight == -1;
}

/// Whether they are the same by their parts.
template <Scalar S>
bool is_same(const Displacement<S>& x, const Displacement<S>& y) {
  const auto same = [](const auto& a, const auto& b) { return a.offset == b.offset && a.weight == b.weight; };
  return x.shift.size() == y.shift.size() && (x.shift.size() == 0 || x.shift == y.shift) &&
         std::ranges::equal(x.blocks, y.blocks, same);
}

/// r_i += weight a_i for i < count, which for the usual weights 1 and -1 is an addition each; `t` is scratch.
template <Scalar S, class Count>
void add_weighted(S* r, const S& weight, const S* a, Count count, S& t) {
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
template <Scalar S, class Count>
void displace(const Displacement<S>& x, Index dimension, Lanes<const S, Count> q, S* out, Index stride) {
  if (is_pair(x)) {
    const S* a = q[x.blocks[0].offset];
    const S* b = q[x.blocks[1].offset];
    for (Index j = 0; j < dimension; ++j, out += stride, a += q.count, b += q.count)
      for (Index i = 0; i < q.count; ++i) set_difference(out[i], a[i], b[i]);
    return;
  }
  S& t = scratch<S>();
  for (Index j = 0; j < dimension; ++j, out += stride) {
    bool first = true;
    for (const auto& block : x.blocks) {
      const S* const column = q[block.offset + j];
      if (!first)
        add_weighted(out, block.weight, column, q.count, t);
      else if (block.weight == 1)
        for (Index i = 0; i < q.count; ++i) set(out[i], column[i]);
      else
        for (Index i = 0; i < q.count; ++i) set_product(out[i], block.weight, column[i]);
      first = false;
    }
    if (first)
      for (Index i = 0; i < q.count; ++i) set_zero(out[i]);
    if (x.shift.size() == 0) continue;
    for (Index i = 0; i < q.count; ++i) set_sum(out[i], out[i], x.shift[j]);
  }
}

/// The same of one q.
template <Scalar S>
Vector<S> displaced(const Displacement<S>& x, Index dimension, const Vector<S>& q) {
  Vector<S> result = Vector<S>::Zero(dimension);
  displace(x, dimension, lanes(q), result.data(), 1);
  return result;
}
/// Without the shift: how the displacement changes with q.
template <Scalar S>
Vector<S> moved(const Displacement<S>& x, Index dimension, const Vector<S>& v) {
  return displaced(Displacement<S>{x.blocks, {}}, dimension, v);
}

/// The coordinates it depends on.
template <Scalar S>
std::set<Index> coordinates(const Displacement<S>& x, Index dimension) {
  std::set<Index> found;
  for (const auto& block : x.blocks)
    for (Index j = 0; j < dimension; ++j) found.insert(block.offset + j);
  return found;
}

/// The sum of the magnitudes of its weights.
template <Scalar S>
S total_weight(const Displacement<S>& x) {
  S sum = 0;
  for (const auto& block : x.blocks) sum += magnitude(block.weight);
  return sum;
}
/// An upper bound of its components where max |q_i| = r.
template <Scalar S>
S reach(const Displacement<S>& x, const S& r) {
  return total_weight(x) * r + max_norm(x.shift);
}

/// The displacement with all weights positive.
template <Scalar S>
Displacement<S> positive(Displacement<S> x) {
  for (auto& block : x.blocks) block.weight = magnitude(block.weight);
  return x;
}

template <Scalar S>
Displacement<double> in_double(const Displacement<S>& x) {
  Displacement<double> result;
  for (const auto& block : x.blocks) result.blocks.push_back({block.offset, approximately(block.weight)});
  result.shift = in_double(x.shift);
  return result;
}

}  // namespace hbvm::core
