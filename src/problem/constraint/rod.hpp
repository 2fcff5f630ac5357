#pragma once

#include <array>

#include "hbvm/error.hpp"
#include "linear/constant_count.hpp"
#include "problem/constraint/displacement_product.hpp"

namespace hbvm::core {

/// g = |x|^2 - square for a displacement x. That is the distance of two bodies, of a body and a fixed point, or the
/// length of a director of a rigid body.
template <Scalar S>
struct Rod {
  Displacement<S> x;
  S square;

  static constexpr std::string_view kind = "rod";
  static constexpr std::array<ConstraintKey, 2> keys{
      {{"between", ConstraintKey::Takes::pair}, {"length", ConstraintKey::Takes::number}}};
  static Rod from(const ConstraintInput<S>& input) {
    const S& length = input.number("length");
    if (!(length > 0)) throw InputError("the length of a rod must be positive");
    return {input.pair("between"), S(length * length)};
  }

  /// |x|^2 is the product of x with itself.
  DisplacementProduct<S> as_product() const { return {x, x, square}; }

  std::set<Index> coordinates(Index dimension) const { return hbvm::core::coordinates(x, dimension); }

  ConstraintValue<S> value(Index dimension, const Vector<S>& q) const {
    const Vector<S> a = displaced(x, dimension, q);
    return DisplacementProduct<S>::value_of(a, a, square, max_norm(q));
  }

  S gradient_size(Index dimension, const S& r) const { return S(2 * dimension) * total_weight(x) * reach(x, r); }

  S curvature(Index dimension, const Vector<S>& v) const { return as_product().curvature(dimension, v); }

  template <class Add>
  void second_derivatives(Index dimension, Add add) const {
    as_product().second_derivatives(dimension, add);
  }

  Rod positive() const { return {hbvm::core::positive(x), square}; }
  Rod<double> in_double() const { return {hbvm::core::in_double(x), approximately(square)}; }

  template <class Conditions>
  void stays(Conditions& conditions) const {
    conditions.length_stays(x);
  }

  class Gradient {
   public:
    Gradient(const Rod& form, Index dimension, const std::vector<Index>& coordinates)
        : form_(form), dimension_(dimension), shares_(dimension, coordinates), is_pair_(is_pair(form.x)) {
      shares_.add(form.x, GradientShares<S>::Of::x);
      if (!is_pair_) return;
      from_ = form.x.blocks[0].offset;
      minus_ = form.x.blocks[1].offset;
      column_ = shares_.first_column(form.x.blocks[0]);
      opposite_ = shares_.first_column(form.x.blocks[1]);
    }

    void begin(const GradientTarget<S>&) const {}
    bool is_opposite() const { return is_pair_; }

    template <class Count>
    [[gnu::always_inline]] void update(Lanes<const S, Count> q, const GradientTarget<S, Count>& to) const {
      if (is_pair_)
        return with_constant_dimension<S>(
            dimension_, [&](auto dimension) __attribute__((always_inline)) { update_pair(dimension, q, to); });
      displace(form_.x, dimension_, q, to.x.data(), to.lanes);
      if (to.g) set_value(to.x.data(), to);
      for (Index i = 0; i < to.x.size(); ++i) set_sum(to.x.data()[i], to.x.data()[i], to.x.data()[i]);
      shares_.spread(to);
    }

    OperationCounts operations() const {
      OperationCounts counts = hbvm::core::operations(form_.x, dimension_) + shares_.operations();
      counts.add(Op::add, dimension_);
      return counts;
    }

   private:
    /// g = x.x - square, from a displacement with its components `lanes` apart.
    template <class Count>
    void set_value(const S* components, const GradientTarget<S, Count>& to) const {
      for (Index i = 0; i < to.lanes; ++i) {
        const S* component = components + i;
        set_product(to.g[i], *component, *component);
        for (Index j = 1; j < dimension_; ++j) {
          component += to.lanes;
          add_product(to.g[i], *component, *component, to.t);
        }
        set_difference(to.g[i], to.g[i], form_.square);
      }
    }

    /// Between two bodies, as most rods are: 2 x and -2 x, in the columns themselves.
    template <class Dimension, class Count>
    [[gnu::always_inline]] void update_pair(Dimension dimension, Lanes<const S, Count> q,
                                            const GradientTarget<S, Count>& to) const {
      const Index size = dimension * to.lanes;
      const S* __restrict const a = q[from_];
      const S* __restrict const b = q[minus_];
      S* __restrict const columns = to.column(column_);
      S* __restrict const opposite = to.column(opposite_);
      for (Index i = 0; i < size; ++i) set_difference(columns[i], a[i], b[i]);
      if (to.g) set_value(columns, to);
      for (Index i = 0; i < size; ++i) {
        set_sum(columns[i], columns[i], columns[i]);
        set_negative(opposite[i], columns[i]);
      }
    }

    const Rod& form_;
    Index dimension_;
    GradientShares<S> shares_;
    bool is_pair_;
    Index from_ = 0, minus_ = 0, column_ = 0, opposite_ = 0;  ///< of a pair: coordinates, and their columns
  };
};

}  // namespace hbvm::core
