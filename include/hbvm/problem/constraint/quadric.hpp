#pragma once

#include <variant>

#include "hbvm/problem/constraint/plane.hpp"

namespace hbvm {

/// g = x^T A x + b^T x + c for the coordinates x of one body, or of several, A symmetric.
template <Scalar S>
struct Quadric {
  std::vector<Index> blocks;  ///< where each body's coordinates begin, ascending
  Matrix<S> A;
  Vector<S> b;
  S c;

  static constexpr std::string_view kind = "quadric";
  static constexpr std::array<ConstraintKey, 4> keys{{{"body", ConstraintKey::Takes::body},
                                                      {"A", ConstraintKey::Takes::symmetric_matrix},
                                                      {"b", ConstraintKey::Takes::vector},
                                                      {"c", ConstraintKey::Takes::number}}};
  /// Without A it is a plane, and treated so.
  static std::variant<Quadric, Plane<S>> from(const ConstraintUse<S>& use) {
    const Matrix<S>& A = use.matrix("A");
    if (A == Matrix<S>::Zero(A.rows(), A.cols()))
      return Plane<S>{use.body("body"), use.vector("b"), S(-use.number("c"))};
    return Quadric{{use.body("body")}, A, use.vector("b"), use.number("c")};
  }

  /// Where coordinate i of x stands in q.
  Index at(Index dimension, Index i) const { return blocks[static_cast<std::size_t>(i / dimension)] + i % dimension; }

  std::set<Index> coordinates(Index dimension) const {
    std::set<Index> found;
    for (Index j = 0; j < b.size(); ++j) found.insert(at(dimension, j));
    return found;
  }

  ConstraintValue<S> value(Index dimension, const Vector<S>& q) const {
    ConstraintValue<S> sum;
    for (Index i = 0; i < A.rows(); ++i) {
      const S& x = q[at(dimension, i)];
      for (Index j = 0; j < A.cols(); ++j) sum.add(x * A(i, j) * q[at(dimension, j)]);
      sum.add(b[i] * x);
    }
    sum.add(c);
    return sum;
  }

  S gradient_size(Index, const S& r) const {
    const Index n = b.size();
    return S(n) * (S(2 * n) * max_norm(A) * r + max_norm(b));
  }

  S curvature(Index dimension, const Vector<S>& v) const {
    S sum = 0;
    for (Index i = 0; i < A.rows(); ++i)
      for (Index j = 0; j < A.cols(); ++j) sum += v[at(dimension, i)] * A(i, j) * v[at(dimension, j)];
    return 2 * sum;
  }

  template <class Add>
  void second_derivatives(Index dimension, Add add) const {
    for (Index i = 0; i < A.rows(); ++i)
      for (Index j = 0; j < A.cols(); ++j) add(at(dimension, i), at(dimension, j), S(2 * A(i, j)));
  }

  Quadric positive() const { return {blocks, magnitudes(A), b, c}; }
  Quadric<double> in_double() const { return {blocks, hbvm::in_double(A), hbvm::in_double(b), approximately(c)}; }

  template <class Conditions>
  void stays(Conditions& conditions) const {
    conditions.quadratic_stays(blocks, A, b);
  }

  class Gradient {
   public:
    Gradient(const Quadric& form, Index dimension, const std::vector<Index>&) : form_(form), dimension_(dimension) {}

    void begin(const GradientTarget<S>&) const {}

    template <class Count>
    void update(Lanes<const S, Count> q, const GradientTarget<S, Count>& to) const {
      const auto lanes = to.lanes;
      if (to.g)
        for (Index i = 0; i < lanes; ++i) set(to.g[i], form_.c);
      for (Index j = 0; j < form_.b.size(); ++j) {
        S* const column = to.column(j);
        for (Index i = 0; i < lanes; ++i) set_zero(column[i]);
        for (Index l = 0; l < form_.b.size(); ++l)
          if (form_.A(j, l) != 0) add_weighted(column, form_.A(j, l), q[form_.at(dimension_, l)], lanes, to.t);
        if (to.g) {
          for (Index i = 0; i < lanes; ++i) {
            set_sum(to.t, column[i], form_.b[j]);
            set_product(to.t, to.t, q[form_.at(dimension_, j)][i]);
            set_sum(to.g[i], to.g[i], to.t);
          }
        }
        for (Index i = 0; i < lanes; ++i) {
          set_sum(column[i], column[i], column[i]);
          set_sum(column[i], column[i], form_.b[j]);
        }
      }
    }

    OperationCounts operations() const {
      OperationCounts counts;
      for (Index i = 0; i < form_.A.size(); ++i)
        if (form_.A.data()[i] != 0) counts.add_products(1);
      counts.add(Op::add, 2 * form_.b.size());
      return counts;
    }

   private:
    const Quadric& form_;
    Index dimension_;
  };
};

}  // namespace hbvm
