#pragma once

#include <array>
#include <set>
#include <vector>

#include "hbvm/problem/constraint/gradient_target.hpp"
#include "hbvm/problem/constraint/use.hpp"
#include "hbvm/problem/constraint/value.hpp"

namespace hbvm {

/// g = n.q - offset for the coordinates q[block ...] of one body: linear, so that its gradient is written once.
template <Scalar S>
struct Plane {
  Index block = 0;
  Vector<S> normal;
  S offset;

  static constexpr std::string_view kind = "plane";
  static constexpr std::array<ConstraintKey, 3> keys{{{"body", ConstraintKey::Takes::body},
                                                      {"normal", ConstraintKey::Takes::vector},
                                                      {"offset", ConstraintKey::Takes::number}}};
  static Plane from(const ConstraintUse<S>& use) {
    return {use.body("body"), use.vector("normal"), use.number("offset")};
  }

  std::set<Index> coordinates(Index) const {
    std::set<Index> found;
    for (Index j = 0; j < normal.size(); ++j) found.insert(block + j);
    return found;
  }

  ConstraintValue<S> value(Index, const Vector<S>& q) const {
    ConstraintValue<S> sum;
    for (Index i = 0; i < normal.size(); ++i) sum.add(normal[i] * q[block + i]);
    sum.add(-offset);
    return sum;
  }

  S gradient_size(Index dimension, const S&) const { return S(dimension) * max_norm(normal); }

  S curvature(Index, const Vector<S>&) const { return 0; }
  template <class Add>
  void second_derivatives(Index, Add) const {}

  Plane positive() const { return *this; }
  Plane<double> in_double() const { return {block, hbvm::in_double(normal), approximately(offset)}; }

  template <class Conditions>
  void stays(Conditions& conditions) const {
    conditions.component_stays(normal, Displacement<S>{{{block, S(1)}}, {}});
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
        add_weighted(to.g, form_.normal[j], q[form_.block + j], to.lanes, to.t);
    }

    OperationCounts operations() const { return {}; }

   private:
    const Plane& form_;
  };
};

}  // namespace hbvm
