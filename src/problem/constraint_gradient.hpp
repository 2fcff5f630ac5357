#pragma once

#include <vector>

#include "linear/constant_count.hpp"
#include "linear/in_double.hpp"
#include "problem/problem.hpp"

namespace hbvm::core {

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
  /// The same, or without g if it is null, with the number of lanes as a constant if it is one of its type.
  template <class Count>
  [[gnu::always_inline]] void update(Lanes<const S, Count> q, S* g) {
    weighed_ = false;
    const std::size_t count = patterns_.size();
    for (std::size_t a = 0; a < count; ++a) {
      const GradientTarget<S, Count> to = target(a, g ? g + static_cast<Index>(a) * q.count : nullptr, q.count);
      // As most are: to call it by std::visit takes as long as it does itself.
      if (const auto* const rod = std::get_if<typename Rod<S>::Gradient>(&gradients_[a]))
        rod->update(q, to);
      else
        std::visit([&](const auto& gradient) { gradient.update(q, to); }, gradients_[a]);
    }
  }

  /// The operations of one update, and of M^-1 grad g, in all lanes.
  OperationCounts operations() const;
  OperationCounts weighing_operations() const;
  /// The operations of transposed_times() for one constraint, and of add_times(), in all lanes.
  OperationCounts transposed_operations(Index a) const;
  OperationCounts times_operations() const;
  /// Numbers stored for grad g in one lane.
  Index stored() const { return values_.cols(); }

  /// result_i = (grad g^T v)_a in lane i, for all lanes.
  void transposed_times(Index a, Lanes<const S> v, S* result);
  /// The same for all a, from out(a) on, with the number of lanes as a constant if it is one of its type.
  template <class Count, class Out>
  [[gnu::always_inline]] void transposed_times(Lanes<const S, Count> v, Out out) {
    with_constant_dimension<S>(
        run_length_, [&](auto length) __attribute__((always_inline)) {
          const std::size_t count = patterns_.size();
          for (std::size_t a = 0; a < count; ++a) transposed_times(length, patterns_[a], v, out(static_cast<Index>(a)));
        });
  }
  /// out += grad g lambda in every lane, with lambda (lanes x nu).
  void add_times(const Matrix<S>& lambda, Lanes<S> out);
  template <class Count>
  [[gnu::always_inline]] void add_times(const Matrix<S>& lambda, Lanes<S, Count> out) {
    with_constant_dimension<S>(
        run_length_, [&](auto length) __attribute__((always_inline)) {
          add_times(length, runs_, values_.data(), lambda.data(), out, t_);
        });
  }
  /// out += M^-1 grad g lambda in every lane.
  void add_weighted_times(const Matrix<S>& lambda, Lanes<S> out);

  /// grad g_a(q_i)^T M^-1 grad g_b(q_j) is 0 but for these pairs (a, b).
  struct Coupling {
    Index a, b;
    /// Columns of the stored gradients that meet, and those next to them, of all couplings as many.
    struct Term {
      Index left, right;
    };
    std::vector<Term> terms;
    Index products;  ///< of a pair of lanes
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
  /// f(a, b, at) for each pair that couples, with at(i, j) = grad g_a(q_i)^T M^-1 grad g_b(q_j). Of (a, b) and (b, a),
  /// which are each other's transposes, one is computed, in `result`. The number of lanes may be a constant of its
  /// type.
  template <class Count, class F>
  void for_each_own_coupling(Count lanes, S* result, F&& f) {
    const S* const right_columns = weighted_values().data();
    for (const Coupling& pair : couplings_) {
      if (pair.a > pair.b) continue;
      couple(lanes, pair, right_columns, result);
      f(pair.a, pair.b, [&](Index i, Index j) -> const S& { return result[i + j * lanes]; });
      if (pair.a < pair.b) f(pair.b, pair.a, [&](Index i, Index j) -> const S& { return result[j + i * lanes]; });
    }
  }
  /// Its products.
  OperationCounts own_coupling_operations() const;
  /// The Gram matrix grad g^T M^-1 grad g of the first lane, nu x nu.
  void gram(Matrix<S>& result);

  /// The stored columns of one constraint: coordinates[k] is the coordinate of column first + k.
  struct Pattern {
    Index first = 0;
    std::vector<Index> coordinates;  ///< ascending
    std::size_t first_run = 0, runs = 0;
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
  /// The place of stored columns next to each other, always as many. It says what they are derivatives of, by which
  /// coordinate the first is, and by which one its negative.
  struct Run {
    Index column, constraint, coordinate, opposite;
  };
  static constexpr Index none = -1;
  /// The runs of all patterns, and which are a pattern's own.
  /// \return their length: the dimension, if all columns are of vectors in space, else 1
  Index find_runs(std::vector<Pattern>& patterns, std::vector<Run>& runs) const;
  void weigh() const;
  template <class Length, class Count>
  static void add_times(Length length, const std::vector<Run>& runs, const S* values, const S* lambda,
                        Lanes<S, Count> out, S& scratch);
  template <class Length, class Count>
  void transposed_times(Length length, const Pattern& pattern, Lanes<const S, Count> v, S* result);
  /// So many columns of M^-1 grad g: to = factor from, or += if it is not the first; no factor stands for 1.
  struct Weighing {
    Index to, from, count;
    bool first;
    const S* factor;
  };
  /// The columns that meet, and how many next to each other always do: the dimension, or 1.
  void find_couplings();
  void prepare_weighing(const Pattern& from, const Pattern& to);
  void add_weighing(const Weighing& next);  ///< together with the last one, if they are alike
  template <class Count>
  [[gnu::always_inline]] GradientTarget<S, Count> target(std::size_t a, S* g, Count lanes) {
    return {lanes, values_.data() + patterns_[a].first * lanes, g, x_, y_, t_};
  }
  template <class Count>
  void couple(Count lanes, const Coupling& pair, const S* right_columns, S* result) {
    with_constant_dimension<S>(
        coupling_length_, [&](auto length)
                              __attribute__((always_inline)) { couple(length, lanes, pair, right_columns, result); });
  }
  template <class Length, class Count>
  void couple(Length length, Count lanes, const Coupling& pair, const S* right_columns, S* result);

  const Problem<S>& problem_;
  Index lanes_;
  std::vector<Pattern> patterns_, weighted_patterns_;
  std::vector<Run> runs_, weighted_runs_;
  Index run_length_ = 1, weighted_run_length_ = 1;
  std::vector<typename GradientsOf<ConstraintForms<S>>::type> gradients_;
  std::vector<Weighing> weighings_;
  Matrix<S> values_;             // lanes x stored columns
  mutable Matrix<S> weighted_;   // likewise
  mutable bool weighed_ = true;  // the last values
  std::vector<Coupling> couplings_;
  Index coupling_length_ = 1;  // of the runs that its terms begin
  Matrix<S> x_, y_;            // scratch: lanes x dimension
  mutable S t_, u_;
};

template <Scalar S>
template <class Length, class Count>
[[gnu::always_inline]] inline void ConstraintGradient<S>::add_times(Length length, const std::vector<Run>& runs,
                                                                    const S* values, const S* lambda,
                                                                    Lanes<S, Count> out, S& scratch) {
  const Count lanes = out.count;
  HeldScratch<S> t = scratch;
  for (const Run& run : runs) {
    const S* __restrict column = values + run.column * lanes;
    const S* __restrict const multiplier = lambda + run.constraint * lanes;
    S* sum = out[run.coordinate];
    S* opposite = run.opposite == none ? nullptr : out[run.opposite];
    for (Index c = 0; c < length; ++c, column += lanes, sum += lanes) {
      if (!opposite) {
        for (Index i = 0; i < lanes; ++i) add_product(sum[i], column[i], multiplier[i], t);
        continue;
      }
      for (Index i = 0; i < lanes; ++i) {
        set_product(t, column[i], multiplier[i]);
        set_sum(sum[i], sum[i], t);
        set_difference(opposite[i], opposite[i], t);
      }
      opposite += lanes;
    }
  }
}

template <Scalar S>
template <class Length, class Count>
[[gnu::always_inline]] inline void ConstraintGradient<S>::transposed_times(Length length, const Pattern& pattern,
                                                                           Lanes<const S, Count> v, S* result) {
  const Count lanes = v.count;
  HeldScratch<S> t = t_, difference = u_;
  const Run* const runs = runs_.data() + pattern.first_run;
  const auto add_to = [&](S * sums) __attribute__((always_inline)) {
    bool first = true;
    for (std::size_t r = 0; r < pattern.runs; ++r) {
      const Run& run = runs[r];
      const S* column = values_.data() + run.column * lanes;
      const S* in = v[run.coordinate];
      const S* opposite = run.opposite == none ? nullptr : v[run.opposite];
      for (Index c = 0; c < length; ++c, column += lanes, in += lanes, first = false) {
        for (Index i = 0; i < lanes; ++i) {
          if (opposite) set_difference(difference, in[i], opposite[i]);
          if (first)
            set_product(sums[i], column[i], opposite ? difference : in[i]);
          else
            add_product(sums[i], column[i], opposite ? difference : in[i], t);
        }
        if (opposite) opposite += lanes;
      }
    }
  };
  if constexpr (is_constant_count<Count>) {
    S sums[Count::value] = {};
    add_to(sums);
    for (Index i = 0; i < lanes; ++i) result[i] = sums[i];
  } else {
    add_to(result);
  }
}

template <Scalar S>
template <class Length, class Count>
[[gnu::always_inline]] inline void ConstraintGradient<S>::couple(Length length, Count lanes, const Coupling& pair,
                                                                 const S* right_columns, S* result) {
  const S* const columns = values_.data();
  if constexpr (is_constant_count<Count>) {
    S sums[Count::value * Count::value] = {};
    for (const auto& term : pair.terms) {
      const S* x = columns + term.left * lanes;
      const S* y = right_columns + term.right * lanes;
      for (Index c = 0; c < length; ++c, x += lanes, y += lanes)
        for (Index j = 0; j < lanes; ++j)
          for (Index i = 0; i < lanes; ++i) sums[i + j * lanes] += x[i] * y[j];
    }
    for (Index i = 0; i < lanes * lanes; ++i) result[i] = sums[i];
    return;
  }
  bool first = true;
  for (const auto& term : pair.terms) {
    const S* x = columns + term.left * lanes;
    const S* y = right_columns + term.right * lanes;
    for (Index c = 0; c < length; ++c, x += lanes, y += lanes, first = false) {
      S* out = result;
      for (Index j = 0; j < lanes; ++j, out += lanes) {
        if (first)
          for (Index i = 0; i < lanes; ++i) set_product(out[i], x[i], y[j]);
        else
          for (Index i = 0; i < lanes; ++i) add_product(out[i], x[i], y[j], t_);
      }
    }
  }
}

}  // namespace hbvm::core
