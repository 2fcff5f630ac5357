#pragma once

#include <variant>

#include "problem/constraint/plane.hpp"

namespace hbvm::core {

/// g = x^T A x + b^T x + c with A symmetric. The coordinates x are those of one body, of several, or of the blocks that
/// a point of a rigid body is a sum of.
template <Scalar S>
struct Quadric {
  std::vector<Index> blocks;  ///< where each body's, or director's, coordinates begin, ascending
  Matrix<S> A;
  Vector<S> b;
  S c;

  static constexpr std::string_view kind = "quadric";
  static constexpr std::array<ConstraintKey, 4> keys{{{"body", ConstraintKey::Takes::body},
                                                      {"A", ConstraintKey::Takes::symmetric_matrix},
                                                      {"b", ConstraintKey::Takes::vector},
                                                      {"c", ConstraintKey::Takes::number}}};
  /// Without A it is a plane, and treated so.
  static std::variant<Quadric, Plane<S>> from(const ConstraintInput<S>& input) {
    const Matrix<S>& A = input.matrix("A");
    const Displacement<S>& x = input.body("body");
    if (A == Matrix<S>::Zero(A.rows(), A.cols())) return Plane<S>::of(x, input.vector("b"), S(-input.number("c")));
    return of(x, A, input.vector("b"), input.number("c"));
  }
  /// x^T A x + b^T x + c of a sum x of blocks, in the coordinates that it is made of.
  static Quadric of(const Displacement<S>& x, const Matrix<S>& A, const Vector<S>& b, const S& c) {
    const Index d = b.size(), size = static_cast<Index>(x.blocks.size()) * d;
    Quadric g{{}, Matrix<S>(size, size), Vector<S>(size), c};
    Vector<S> slope = b;  // b + 2 A shift
    if (x.shift.size() > 0)
      for (Index i = 0; i < d; ++i) {
        S of_shift = 0;
        for (Index j = 0; j < d; ++j) of_shift += A(i, j) * x.shift[j];
        g.c += x.shift[i] * (b[i] + of_shift);
        slope[i] += 2 * of_shift;
      }
    for (const auto& one : x.blocks) {
      const auto row = static_cast<Index>(g.blocks.size()) * d;
      for (Index i = 0; i < d; ++i) {
        g.b[row + i] = one.weight * slope[i];
        Index column = 0;
        for (const auto& other : x.blocks)
          for (Index j = 0; j < d; ++j, ++column) g.A(row + i, column) = one.weight * other.weight * A(i, j);
      }
      g.blocks.push_back(one.offset);
    }
    return g;
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
  Quadric<double> in_double() const {
    return {blocks, hbvm::core::in_double(A), hbvm::core::in_double(b), approximately(c)};
  }

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

}  // namespace hbvm::core
