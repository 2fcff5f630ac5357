#pragma once

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <vector>

#include "problem/constraint/gradient_shares.hpp"
#include "problem/constraint/input.hpp"
#include "problem/constraint/parts.hpp"
#include "problem/constraint/value.hpp"

namespace hbvm::core {

/// g = x_i, a component of a displacement x: linear, so that its gradient is written once. All of them together hold
/// two points in one place: a ball joint, which in the plane is a pin.
template <Scalar S>
struct CommonPoint {
  Displacement<S> x;
  Index component;

  static constexpr std::string_view kind = "ball_joint";
  static constexpr std::array<ConstraintKey, 1> keys{{{"between", ConstraintKey::Takes::pair}}};
  static ConstraintParts<CommonPoint> from(const ConstraintInput<S>& input) {
    return of(input.pair("between"), input.dimension);
  }
  /// All components.
  static ConstraintParts<CommonPoint> of(const Displacement<S>& x, Index dimension) {
    ConstraintParts<CommonPoint> parts;
    for (Index i = 0; i < dimension; ++i) parts.push_back({std::string("point, ") + "xyz" [i], CommonPoint { x, i }});
    return parts;
  }

  std::set<Index> coordinates(Index) const {
    std::set<Index> found;
    for (const auto& block : x.blocks) found.insert(block.offset + component);
    return found;
  }

  ConstraintValue<S> value(Index, const Vector<S>& q) const {
    ConstraintValue<S> sum;
    for (const auto& block : x.blocks) sum.add(block.weight * q[block.offset + component]);
    if (x.shift.size() > 0) sum.add(x.shift[component]);
    return sum;
  }

  S gradient_size(Index, const S&) const { return total_weight(x); }

  S curvature(Index, const Vector<S>&) const { return 0; }
  template <class Add>
  void second_derivatives(Index, Add) const {}

  CommonPoint positive() const { return *this; }
  CommonPoint<double> in_double() const { return {hbvm::core::in_double(x), component}; }

  template <class Conditions>
  void stays(Conditions& conditions) const {
    conditions.vanishes(x, component);
  }

  class Gradient {
   public:
    Gradient(const CommonPoint& form, Index, const std::vector<Index>& coordinates) : form_(form) {
      for (const auto& block : form.x.blocks) {
        const auto at = std::lower_bound(coordinates.begin(), coordinates.end(), block.offset + form.component);
        columns_.push_back(static_cast<Index>(at - coordinates.begin()));
      }
    }

    void begin(const GradientTarget<S>& to) const {
      for (std::size_t b = 0; b < columns_.size(); ++b)
        for (Index i = 0; i < to.lanes; ++i) set(to.column(columns_[b])[i], form_.x.blocks[b].weight);
    }

    template <class Count>
    void update(Lanes<const S, Count> q, const GradientTarget<S, Count>& to) const {
      if (!to.g) return;
      for (Index i = 0; i < to.lanes; ++i) {
        if (form_.x.shift.size() > 0)
          set(to.g[i], form_.x.shift[form_.component]);
        else
          set_zero(to.g[i]);
      }
      for (const auto& block : form_.x.blocks)
        add_weighted(to.g, block.weight, q[block.offset + form_.component], to.lanes, to.t);
    }

    OperationCounts operations() const { return {}; }

   private:
    const CommonPoint& form_;
    std::vector<Index> columns_;
  };
};

}  // namespace hbvm::core
