#include "hbvm/problem/space/displacement.hpp"

namespace hbvm {

template <Scalar S>
void displace(const Displacement<S>& x, Index dimension, Lanes<const S> q, S* out, Index stride) {
  if (x.blocks.size() == 2 && x.shift.size() == 0 && x.blocks[0].weight == 1 && x.blocks[1].weight == -1) {
    // The usual pair, in one pass.
    for (Index j = 0; j < dimension; ++j, out += stride) {
      const S* const a = q[x.blocks[0].offset + j];
      const S* const b = q[x.blocks[1].offset + j];
      for (Index i = 0; i < q.count; ++i) set_difference(out[i], a[i], b[i]);
    }
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

#define HBVM_DEFINE(S) template void displace<S>(const Displacement<S>&, Index, Lanes<const S>, S*, Index);
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm
