#pragma once

#include <algorithm>
#include <memory>
#include <set>
#include <vector>

#include "problem/constraint/gradient_target.hpp"
#include "problem/constraint/value.hpp"
#include "problem/effect/execution.hpp"
#include "problem/effect/term.hpp"

namespace hbvm::core {

/// g by a formula of a scene that is not quadratic: its second derivative depends on q. What other forms say of
/// themselves as ConstraintForm follows here from the trace of the formula, which `term` holds for one instance.
template <Scalar S>
struct FormulaConstraint {
  EffectTerm<S> term;

  /// The degree of g as a polynomial in q; Trace::not_polynomial if it is none.
  int degree() const { return term.degree; }

  std::set<Index> coordinates(Index dimension) const {
    std::set<Index> found;
    for (const Displacement<S>& x : term.displacements) found.merge(hbvm::core::coordinates(x, dimension));
    return found;
  }

  /// The size is that of rounding_sizes: a formula has no terms to add up.
  ConstraintValue<S> value(Index dimension, const Vector<S>& q) const {
    const At at(*this, dimension, q);
    ConstraintValue<S> result;
    set(result.g, outputs_of(term.value, term.value_coefficients, at.x)(0, 0));
    set(result.size, at.sizes(term.value, term.value_coefficients).front());
    return result;
  }

  S gradient_size(Index dimension, const Vector<S>& q) const {
    const At at(*this, dimension, q);
    const std::vector<S> sizes = at.sizes(term.gradient, term.gradient_coefficients);
    S sum = 0;
    for (Index i = 0; i < at.x.cols(); ++i)
      sum += sizes[static_cast<std::size_t>(i)] * total_weight(term.displacement(0, i / dimension));
    return sum;
  }

  /// (nabla^2 g)(v, v) at q.
  S curvature(Index dimension, const Vector<S>& q, const Vector<S>& v) const {
    const At at(*this, dimension, q), along(*this, dimension, v, At::moving);
    const Matrix<S> hessian = outputs_of(term.hessian, term.hessian_coefficients, at.x);
    S sum = 0;
    for_each_pair(at.x.cols(), [&](Index n, Index i, Index j) {
      sum += (i == j ? 1 : 2) * hessian(0, n) * along.x(0, i) * along.x(0, j);
    });
    return sum;
  }
  /// The sum of the sizes of its terms.
  S curvature_size(Index dimension, const Vector<S>& q, const Vector<S>& v) const {
    const At at(*this, dimension, q), along(*this, dimension, v, At::moving);
    const std::vector<S> sizes = at.sizes(term.hessian, term.hessian_coefficients);
    S sum = 0;
    for_each_pair(at.x.cols(), [&](Index n, Index i, Index j) {
      sum += (i == j ? 1 : 2) * sizes[static_cast<std::size_t>(n)] * along.size[i] * along.size[j];
    });
    return sum;
  }

  FormulaConstraint<double> in_double() const { return {hbvm::core::in_double(term)}; }

  template <class Conditions>
  void stays(Conditions& conditions) const {
    conditions.effect(term);
  }

  class Gradient {
   public:
    Gradient(const FormulaConstraint& form, Index dimension, const std::vector<Index>& coordinates)
        : form_(form), dimension_(dimension) {
      std::set<Index> touched;
      const Index inputs = form.term.arguments * dimension;
      for (Index i = 0; i < inputs; ++i)
        for (const auto& block : form.term.displacement(0, i / dimension).blocks) {
          const auto at = std::lower_bound(coordinates.begin(), coordinates.end(), block.offset + i % dimension);
          const auto column = static_cast<Index>(at - coordinates.begin());
          shares_.push_back({column, i, touched.insert(column).second, block.weight});
        }
    }

    void begin(const GradientTarget<S>& to) const {
      work_ = std::make_unique<Work>(form_.term, dimension_, static_cast<Index>(to.lanes));
    }

    template <class Count>
    void update(Lanes<const S, Count> q, const GradientTarget<S, Count>& to) const {
      Work& work = *work_;
      const auto lanes = static_cast<Index>(to.lanes);
      displace(form_.term, dimension_, Lanes<const S>{q.data, lanes}, work.x.data(), lanes);
      if (to.g) {
        work.value.run();
        for (Index i = 0; i < lanes; ++i) set(to.g[i], work.value.output(0, i));
      }
      work.gradient.run();
      for (const Share& share : shares_) {
        S* const column = to.column(share.column);
        for (Index i = 0; i < lanes; ++i) {
          const S& slope = work.gradient.output(share.input, i);
          if (share.first)
            set_product(column[i], share.weight, slope);
          else
            add_product(column[i], share.weight, slope, to.t);
        }
      }
    }

    OperationCounts operations() const {
      OperationCounts counts = form_.term.gradient.operations();
      for (const Displacement<S>& x : form_.term.displacements) counts += hbvm::core::operations(x, dimension_);
      for (const Share& share : shares_) counts.add(Op::multiply, 1), counts.add(Op::add, share.first ? 0 : 1);
      return counts;
    }

   private:
    struct Work {
      Matrix<S> x;  // lanes x inputs
      Execution<S> value, gradient;
      Work(const EffectTerm<S>& term, Index dimension, Index lanes)
          : x(Matrix<S>::Zero(lanes, term.arguments * dimension)),
            value(term.value, term.value_coefficients, x, lanes),
            gradient(term.gradient, term.gradient_coefficients, x, lanes) {}
    };
    /// A column gets its weight times dg/dx_input.
    struct Share {
      Index column, input;
      bool first;
      S weight;
    };

    const FormulaConstraint& form_;
    Index dimension_;
    std::vector<Share> shares_;
    mutable std::unique_ptr<Work> work_;  // of as many lanes as there are to begin with
  };

 private:
  /// The inputs of the programs at q, or how v moves them, each with the sum of the magnitudes of its terms.
  struct At {
    enum Of { position, moving };
    Matrix<S> x;  // 1 x inputs
    Vector<S> size;

    At(const FormulaConstraint& form, Index dimension, const Vector<S>& q, Of of = position)
        : x(Matrix<S>::Zero(1, form.term.arguments * dimension)), size(Vector<S>::Zero(x.cols())) {
      for (Index i = 0; i < x.cols(); ++i) {
        const Displacement<S>& from = form.term.displacement(0, i / dimension);
        const auto add = [&](const S& part) {
          x(0, i) += part;
          size[i] += magnitude(part);
        };
        for (const auto& block : from.blocks) add(block.weight * q[block.offset + i % dimension]);
        if (of == position && from.shift.size() > 0) add(from.shift[i % dimension]);
      }
    }

    std::vector<S> sizes(const Program<S>& program, const Matrix<S>& coefficients) const {
      std::vector<S> inputs, own;
      for (Index i = 0; i < x.cols(); ++i) {
        inputs.push_back(x(0, i));
        own.push_back(size[i]);
      }
      for (Index i = 0; i < coefficients.cols(); ++i) {
        inputs.push_back(coefficients(0, i));
        own.push_back(magnitude(coefficients(0, i)));
      }
      return program.rounding_sizes(inputs, own);
    }
  };

  /// f(place in the lower triangle row by row, row, column).
  template <class F>
  static void for_each_pair(Index inputs, F f) {
    for (Index i = 0, n = 0; i < inputs; ++i)
      for (Index j = 0; j <= i; ++j, ++n) f(n, i, j);
  }
};

}  // namespace hbvm::core
