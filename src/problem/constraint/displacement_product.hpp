#pragma once

#include <array>

#include "problem/constraint/gradient_shares.hpp"
#include "problem/constraint/input.hpp"
#include "problem/constraint/value.hpp"

namespace hbvm::core {

/// g = x.y - value for two displacements: the angle between two rods, or of two directors of a rigid body.
template <Scalar S>
struct DisplacementProduct {
  Displacement<S> x, y;
  S product;

  static constexpr std::string_view kind = "angle";
  static constexpr std::array<ConstraintKey, 3> keys{{{"first", ConstraintKey::Takes::pair},
                                                      {"second", ConstraintKey::Takes::pair},
                                                      {"value", ConstraintKey::Takes::number}}};
  static DisplacementProduct from(const ConstraintInput<S>& input) {
    return {input.pair("first"), input.pair("second"), input.number("value")};
  }

  std::set<Index> coordinates(Index dimension) const {
    std::set<Index> found = hbvm::core::coordinates(x, dimension);
    found.merge(hbvm::core::coordinates(y, dimension));
    return found;
  }

  ConstraintValue<S> value(Index dimension, const Vector<S>& q) const {
    return value_of(displaced(x, dimension, q), displaced(y, dimension, q), product, max_norm(q));
  }

  /// a.b - product. Displacements carry the round-off of what they are differences of: `spread` is how large that is.
  static ConstraintValue<S> value_of(const Vector<S>& a, const Vector<S>& b, const S& product, const S& spread) {
    ConstraintValue<S> sum;
    for (Index i = 0; i < a.size(); ++i) {
      sum.add(a[i] * b[i]);
      sum.size += spread * (magnitude(a[i]) + magnitude(b[i]));
    }
    sum.add(-product);
    return sum;
  }

  S gradient_size(Index dimension, const S& r) const {
    return S(dimension) * (total_weight(x) * reach(y, r) + total_weight(y) * reach(x, r));
  }

  S curvature(Index dimension, const Vector<S>& v) const {
    const Vector<S> a = moved(x, dimension, v), b = moved(y, dimension, v);
    S sum = 0;
    for (Index i = 0; i < dimension; ++i) sum += a[i] * b[i];
    return 2 * sum;
  }

  template <class Add>
  void second_derivatives(Index dimension, Add add) const {
    for (const auto& a : x.blocks)
      for (const auto& b : y.blocks)
        for (Index i = 0; i < dimension; ++i) {
          add(a.offset + i, b.offset + i, S(a.weight * b.weight));
          add(b.offset + i, a.offset + i, S(a.weight * b.weight));
        }
  }

  DisplacementProduct positive() const { return {hbvm::core::positive(x), hbvm::core::positive(y), product}; }
  DisplacementProduct<double> in_double() const {
    return {hbvm::core::in_double(x), hbvm::core::in_double(y), approximately(product)};
  }

  template <class Conditions>
  void stays(Conditions& conditions) const {
    conditions.product_stays(x, y);
  }

  class Gradient {
   public:
    Gradient(const DisplacementProduct& form, Index dimension, const std::vector<Index>& coordinates)
        : form_(form), dimension_(dimension), shares_(dimension, coordinates) {
      // d(x.y) = y.dx + x.dy
      shares_.add(form.x, GradientShares<S>::Of::y);
      shares_.add(form.y, GradientShares<S>::Of::x);
    }

    void begin(const GradientTarget<S>&) const {}

    template <class Count>
    void update(Lanes<const S, Count> q, const GradientTarget<S, Count>& to) const {
      displace(form_.x, dimension_, q, to.x.data(), to.lanes);
      displace(form_.y, dimension_, q, to.y.data(), to.lanes);
      if (to.g)
        for (Index i = 0; i < to.lanes; ++i) {
          set_product(to.g[i], to.x(i, 0), to.y(i, 0));
          for (Index j = 1; j < dimension_; ++j) add_product(to.g[i], to.x(i, j), to.y(i, j), to.t);
          set_difference(to.g[i], to.g[i], form_.product);
        }
      shares_.spread(to);
    }

    OperationCounts operations() const {
      return hbvm::core::operations(form_.x, dimension_) + hbvm::core::operations(form_.y, dimension_) +
             shares_.operations();
    }

   private:
    const DisplacementProduct& form_;
    Index dimension_;
    GradientShares<S> shares_;
  };
};

}  // namespace hbvm::core
