#pragma once

#include <array>
#include <set>
#include <vector>

#include "problem/constraint/gradient_target.hpp"
#include "problem/constraint/input.hpp"
#include "problem/constraint/value.hpp"

namespace hbvm::core {

/// g = n.q - offset for the coordinates q of one body, or of the blocks that a point of a rigid body is a sum of. It is
/// linear, so that its gradient is written once.
template <Scalar S>
struct Plane {
  std::vector<Index> blocks;  ///< where each body's, or director's, coordinates begin, ascending
  Vector<S> normal;           ///< d entries for each block
  S offset;

  static constexpr std::string_view kind = "plane";
  static constexpr std::array<ConstraintKey, 3> keys{{{"body", ConstraintKey::Takes::body},
                                                      {"normal", ConstraintKey::Takes::vector},
                                                      {"offset", ConstraintKey::Takes::number}}};
  static Plane from(const ConstraintInput<S>& input) {
    return of(input.body("body"), input.vector("normal"), input.number("offset"));
  }
  /// n.x - offset, in the coordinates that x is made of.
  static Plane of(const Displacement<S>& x, const Vector<S>& n, const S& offset) {
    const Index d = n.size();
    Plane plane{{}, Vector<S>(static_cast<Index>(x.blocks.size()) * d), offset};
    for (const auto& block : x.blocks) {
      const auto first = static_cast<Index>(plane.blocks.size()) * d;
      for (Index j = 0; j < d; ++j) plane.normal[first + j] = block.weight * n[j];
      plane.blocks.push_back(block.offset);
    }
    for (Index j = 0; j < x.shift.size(); ++j) plane.offset -= n[j] * x.shift[j];
    return plane;
  }

  /// Where coordinate i stands in q.
  Index at(Index i) const {
    const Index d = normal.size() / static_cast<Index>(blocks.size());
    return blocks[static_cast<std::size_t>(i / d)] + i % d;
  }

  std::set<Index> coordinates(Index) const {
    std::set<Index> found;
    for (Index j = 0; j < normal.size(); ++j) found.insert(at(j));
    return found;
  }

  ConstraintValue<S> value(Index, const Vector<S>& q) const {
    ConstraintValue<S> sum;
    for (Index i = 0; i < normal.size(); ++i) sum.add(normal[i] * q[at(i)]);
    sum.add(-offset);
    return sum;
  }

  S gradient_size(Index, const S&) const { return S(normal.size()) * max_norm(normal); }

  S curvature(Index, const Vector<S>&) const { return 0; }
  template <class Add>
  void second_derivatives(Index, Add) const {}

  Plane positive() const { return *this; }
  Plane<double> in_double() const { return {blocks, hbvm::core::in_double(normal), approximately(offset)}; }

  template <class Conditions>
  void stays(Conditions& conditions) const {
    if (blocks.size() == 1)
      conditions.component_stays(normal, Displacement<S>{{{blocks.front(), S(1)}}, {}});
    else
      conditions.quadratic_stays(blocks, Matrix<S>::Zero(normal.size(), normal.size()), normal);
  }

  class Gradient {
   public:
    Gradient(const Plane& form, Index, const std::vector<Index>&) : form_(form) {}

    void begin(const GradientTarget<S>& to) const {
      for (Index j = 0; j < form_.normal.size(); ++j)
        for (Index i = 0; i < to.lanes; ++i) set(to.column(j)[i], form_.normal[j]);
    }

    template <class Count>
    void update(Lanes<const S, Count> q, const GradientTarget<S, Count>& to) const {
      if (!to.g) return;
      for (Index i = 0; i < to.lanes; ++i) set_negative(to.g[i], form_.offset);
      for (Index j = 0; j < form_.normal.size(); ++j)
        add_weighted(to.g, form_.normal[j], q[form_.at(j)], to.lanes, to.t);
    }

    OperationCounts operations() const { return {}; }

   private:
    const Plane& form_;
  };
};

}  // namespace hbvm::core
