#pragma once

#include <vector>

#include "linear/constant_count.hpp"
#include "linear/operation_counts.hpp"
#include "problem/space/lanes.hpp"

namespace hbvm::core {

/// The symmetric positive definite M of (1): constant, block-diagonal, a block a body. A scalar mass costs one
/// product a coordinate, mass 1 none, a full block one for each entry of M^-1 that is not 0.
template <Scalar S>
class MassMatrix {
 public:
  struct Block {
    Index offset, size;
    bool full;  ///< M and W are size x size; else mass and inverse_mass hold
    S mass, inverse_mass;
    Matrix<S> M, W;  ///< W = M^-1, correctly rounded but for a unit in the last place
  };

  void add_scalar(Index size, const S& mass);
  /// \throws InputError if M is not symmetric and positive definite
  void add_full(const Matrix<S>& M);
  /// Coordinates that no force moves: M^-1 is 0 there, and they are in no block. They stand after all others.
  void add_driven(Index size);

  /// Number of coordinates.
  Index m() const { return m_; }
  /// Of those that have a mass; they come first.
  Index of_bodies() const { return blocks_.empty() ? 0 : blocks_.back().offset + blocks_.back().size; }
  const std::vector<Block>& blocks() const { return blocks_; }

  /// v = M^-1 p in every lane, in double and MPFR with about one rounding; v must not be p. Along the motion of a rigid
  /// body the roundings of a sum of rounded products are not of either sign alike. H of a heavy top drifts by them.
  void velocity(Lanes<const S> p, Lanes<S> v) const;
  /// The same with the number of lanes as a constant if it is one of its type.
  template <class Count>
  [[gnu::always_inline]] void velocity(Lanes<const S, Count> p, Lanes<S, Count> v) const {
    if constexpr (is_constant_count<Count>) {
      if (full_.empty()) {
        S* __restrict const out = v.data;
        const S* __restrict const in = p.data;
        const S* __restrict const inverse = inverse_masses_.data();
        const auto m = static_cast<Index>(inverse_masses_.size());
#pragma GCC ivdep
        for (Index j = 0; j < m; ++j)
          for (Index i = 0; i < p.count; ++i) out[j * p.count + i] = inverse[j] * in[j * p.count + i];
        return;
      }
    }
    velocity(Lanes<const S>{p.data, p.count}, Lanes<S>{v.data, v.count});
  }
  /// The operations of velocity() in one lane, as of dots that are rounded as usual.
  OperationCounts operations() const {
    OperationCounts counts;
    for (const Block& block : blocks_) {
      if (block.full)
        for (Index j = 0; j < block.size; ++j) counts.add_dots(1, (block.W.col(j).array() != 0).count());
      else if (block.mass != 1)
        counts.add(Op::multiply, block.size);
    }
    return counts;
  }
  /// p = M v.
  Vector<S> momentum(const Vector<S>& v) const;
  void momentum(const Vector<S>& v, Vector<S>& p) const;

 private:
  /// Coordinates next to each other that have one mass.
  struct Span {
    Index offset, size;
    S mass, inverse_mass;
  };
  Index m_ = 0;
  std::vector<Block> blocks_;
  std::vector<Span> spans_;
  std::vector<S> inverse_masses_;  ///< of each coordinate, if all blocks are scalar
  std::vector<std::size_t> full_;  ///< blocks
};

}  // namespace hbvm::core
