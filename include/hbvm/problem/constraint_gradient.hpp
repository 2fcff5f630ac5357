#pragma once

#include <vector>

#include "hbvm/linear/constant_count.hpp"
#include "hbvm/linear/in_double.hpp"
#include "hbvm/problem/problem.hpp"

namespace hbvm {

/// grad g in several lanes, stored by its pattern: for each constraint the coordinates it depends on. Owns the
/// storage, so that evaluating allocates nothing. The problem must outlive it.
template <Scalar S>
class ConstraintGradient {
 public:
  ConstraintGradient(const Problem<S>& problem, Index lanes);

  /// grad g at q; M^-1 grad g follows once it is wanted. What is linear in q is not computed again.
  void update(Lanes<const S> q);
  /// The same and g, lanes x nu, from the same displacements.
  void update(Lanes<const S> q, Matrix<S>& g);

  /// The operations of one update, and of M^-1 grad g, in all lanes.
  OperationCounts operations() const;
  OperationCounts weighing_operations() const;
  /// Those of transposed_times() for one constraint, and of add_times(), in all lanes.
  OperationCounts transposed_operations(Index a) const;
  OperationCounts times_operations() const;
  /// Numbers stored for grad g in one lane.
  Index stored() const { return values_.cols(); }

  /// result_i = (grad g^T v)_a in lane i, for all lanes.
  void transposed_times(Index a, Lanes<const S> v, S* result);
  /// out += grad g lambda in every lane, with lambda (lanes x nu).
  void add_times(const Matrix<S>& lambda, Lanes<S> out);
  /// out += M^-1 grad g lambda in every lane.
  void add_weighted_times(const Matrix<S>& lambda, Lanes<S> out);

  /// grad g_a(q_i)^T M^-1 grad g_b(q_j) is 0 but for these pairs (a, b).
  struct Coupling {
    Index a, b;
    /// Columns of the stored gradients that meet.
    struct Term {
      Index left, right;
    };
    std::vector<Term> terms;
    Index products() const { return static_cast<Index>(terms.size()); }  ///< of a pair of lanes
  };
  const std::vector<Coupling>& couplings() const { return couplings_; }
  /// grad g_a of this in lane i with M^-1 grad g_b of `right`, which may be this, in lane j: result(i, j), column by
  /// column.
  void coupling(const Coupling& pair, const ConstraintGradient& right, S* result);
  /// f(pair) for each of couplings(), with its numbers in `result`.
  template <class F>
  void for_each_coupling(const ConstraintGradient& right, S* result, F&& f) {
    const S* const right_columns = right.weighted_values().data();
    with_constant_count<S>(lanes_, [&](auto lanes) {
      for (const Coupling& pair : couplings_) {
        couple(lanes, pair, right_columns, result);
        f(pair);
      }
    });
  }
  /// The Gram matrix grad g^T M^-1 grad g of the first lane, nu x nu.
  void gram(Matrix<S>& result);

  /// The stored columns of one constraint: coordinates[k] is the coordinate of column first + k.
  struct Pattern {
    Index first = 0;
    std::vector<Index> coordinates;  ///< ascending
    /// The second half of the columns are the negatives of the first, as of a rod between two bodies: half of the
    /// products do.
    bool opposite = false;
    Index column(Index coordinate) const;
  };
  /// The coordinates where grad g_a, and M^-1 grad g_a, can be nonzero, and the values there in every lane.
  const Pattern& pattern(Index a) const { return patterns_[static_cast<std::size_t>(a)]; }
  const Pattern& weighted_pattern(Index a) const { return weighted_patterns_[static_cast<std::size_t>(a)]; }
  const Matrix<S>& values() const { return values_; }
  const Matrix<S>& weighted_values() const {
    if (!weighed_) weigh();
    return weighted_;
  }
  /// Takes the values from those of more digits.
  template <Scalar T>
  void round(const ConstraintGradient<T>& from) requires std::same_as<S, double> {
    set_in_double(values_, from.values());
    weighed_ = false;
  }

 private:
  /// Where a stored column belongs: what it is the derivative of, and by what; and by what its negative is.
  struct Place {
    Index column, constraint, coordinate, opposite;
  };
  static constexpr Index none = -1;
  void weigh() const;
  static void add_times(const std::vector<Place>& places, const Matrix<S>& values, const Matrix<S>& lambda,
                        Lanes<S> out, S& scratch);
  /// So many columns of M^-1 grad g: to = factor from, or += if it is not the first; no factor stands for 1.
  struct Weighing {
    Index to, from, count;
    bool first;
    const S* factor;
  };
  void prepare_weighing(const Pattern& from, const Pattern& to);
  void add_weighing(const Weighing& next);  ///< together with the last one, if they are alike
  void update_all(Lanes<const S> q, Matrix<S>* g);
  template <class Count>
  GradientTarget<S, Count> target(std::size_t a, S* g, Count lanes);
  template <class Count>
  void couple(Count lanes, const Coupling& pair, const S* right_columns, S* result);

  const Problem<S>& problem_;
  Index lanes_;
  std::vector<Pattern> patterns_, weighted_patterns_;
  std::vector<Place> places_, weighted_places_;
  std::vector<typename GradientsOf<ConstraintForms<S>>::type> gradients_;
  std::vector<Weighing> weighings_;
  Matrix<S> values_;             // lanes x stored columns
  mutable Matrix<S> weighted_;   // likewise
  mutable bool weighed_ = true;  // the last values
  std::vector<Coupling> couplings_;
  Matrix<S> x_, y_;  // scratch: lanes x dimension
  mutable S t_, u_;
};

template <Scalar S>
template <class Count>
void ConstraintGradient<S>::couple(Count lanes, const Coupling& pair, const S* right_columns, S* result) {
  const S* const columns = values_.data();
  if constexpr (is_constant_count<Count>) {
    S sums[Count::value * Count::value] = {};
    for (const auto& term : pair.terms) {
      const S* const x = columns + term.left * lanes;
      const S* const y = right_columns + term.right * lanes;
      for (Index j = 0; j < lanes; ++j)
        for (Index i = 0; i < lanes; ++i) sums[i + j * lanes] += x[i] * y[j];
    }
    for (Index i = 0; i < lanes * lanes; ++i) result[i] = sums[i];
    return;
  }
  bool first = true;
  for (const auto& term : pair.terms) {
    const S* const x = columns + term.left * lanes;
    const S* const y = right_columns + term.right * lanes;
    S* out = result;
    for (Index j = 0; j < lanes; ++j, out += lanes) {
      if (first)
        for (Index i = 0; i < lanes; ++i) set_product(out[i], x[i], y[j]);
      else
        for (Index i = 0; i < lanes; ++i) add_product(out[i], x[i], y[j], t_);
    }
    first = false;
  }
}

#define HBVM_DECLARE(S) extern template class ConstraintGradient<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DECLARE)
#undef HBVM_DECLARE

}  // namespace hbvm
