#pragma once

#include <vector>

#include "linear/constant_count.hpp"
#include "linear/matrix.hpp"
#include "linear/operation_counts.hpp"
#include "scalar/archive.hpp"
#include "scalar/binary_exponent.hpp"
#include "scalar/in_place.hpp"

namespace hbvm::core {

/// Continues a sequence x_1, x_2, … of matrices, one a step, column by column by the polynomial through the last
/// elements. It keeps the backward differences D_r = nabla^r x_n, and predicts x_{n+1} as sum_{i <= r} D_i. D_{r+1} is
/// the error that the same prediction of x_n had: r is chosen to make it least. Each column has an r of its own, as
/// columns are coordinates or multipliers of different size and unit.
template <Scalar S>
class Extrapolation {
 public:
  static constexpr Index max_order = 8;

  Extrapolation(Index rows, Index columns)
      : rows_(rows),
        columns_(columns),
        differences_(rows * columns, max_order + 2),
        prediction_(rows * columns),
        next_(rows),
        sums_(rows, max_order + 2),
        orders_(static_cast<std::size_t>(columns)) {}

  void clear() { known_ = 0; }
  bool empty() const { return known_ == 0; }

  /// x_{n+1} = x.
  void add(const S* x) {
    known_ = std::min(known_ + 1, max_order + 2);
    with_constant_count<S>(rows_, [&](auto rows) {
      for (Index column = 0; column < columns_; ++column, x += rows) {
        if constexpr (is_constant_count<decltype(rows)>) {
          S next[rows], sums[rows * (max_order + 2)];
          add(rows, column, x, next, sums);
        } else {
          add(rows, column, x, next_.data(), sums_.data());
        }
      }
    });
  }

  /// The prediction of x_{n+1}; not for an empty sequence.
  void predict(S* x) const {
    for (Index i = 0; i < prediction_.size(); ++i) set(x[i], prediction_[i]);
  }
  /// log2 of the error that the last prediction of a column would have had by its present order.
  long error_exponent(Index column) const {
    const Index difference = order(column) + 1;
    if (difference >= known_) return -exponent_of_zero;
    long greatest = exponent_of_zero;
    for (Index i = 0; i < rows_; ++i)
      greatest = std::max(greatest, binary_exponent(differences_(column * rows_ + i, difference)));
    return greatest;
  }
  /// What a prediction and an element take at most.
  OperationCounts operations() const {
    OperationCounts counts;
    counts.add(Op::add, max_order * prediction_.size());
    counts.add(Op::subtract, (max_order + 1) * prediction_.size());
    return counts;
  }
  Index order(Index column) const { return orders_[static_cast<std::size_t>(column)]; }

  void remember(Archive& archive) {
    archive(known_, orders_);
    for (Index i = 0; i < known_ * prediction_.size(); ++i) archive(differences_.data()[i]);
    for (Index i = 0; i < prediction_.size(); ++i) {
      set(prediction_[i], differences_(i, 0));
      for (Index r = 1; r <= order(i / rows_); ++r) set_sum(prediction_[i], prediction_[i], differences_(i, r));
    }
  }

 private:
  /// The next element of a column, its order and prediction, in one pass over its differences.
  /// \param next scratch of so many rows, and `sums` of so many columns of them as there are differences
  template <class Rows>
  [[gnu::always_inline]] void add(Rows rows, Index column, const S* x, S* __restrict next, S* __restrict sums) {
    HeldScratch<S> least = least_, norm = norm_;
    const Index stride = differences_.rows(), first = column * rows;
    S* __restrict difference = differences_.data() + first;
    for (Index i = 0; i < rows; ++i) set(next[i], x[i]);
    Index best = 1;
    for (Index r = 0; r < known_; ++r, difference += stride) {
      for (Index i = 0; i < rows; ++i) {
        exchange_for_difference(difference[i], next[i]);
        S& sum = sums[r * rows + i];
        if (r == 0)
          set(sum, difference[i]);
        else
          set_sum(sum, sums[(r - 1) * rows + i], difference[i]);
      }
      if (r == 0) continue;
      set_magnitude(norm, difference[0]);
      for (Index i = 1; i < rows; ++i) raise_finite(norm, difference[i]);
      if (r == 1) {
        set(least, norm);
        continue;
      }
      best = by_chance(is_greater(least, norm)) ? r : best;
      lower_finite(least, norm);
    }
    orders_[static_cast<std::size_t>(column)] = best - 1;
    for (Index i = 0; i < rows; ++i) set(prediction_[first + i], sums[(best - 1) * rows + i]);
  }

  /// The new one of a difference, and of the next one.
  static void exchange_for_difference(S& difference, S& next) {
    if constexpr (std::same_as<S, Mpfr>) {
      swap(difference, next);  // Boost's own, which exchanges the digits; the moves of std::swap may round them
      set_difference(next, difference, next);
    } else {
      const S now = next;
      next = now - difference;
      difference = now;
    }
  }

  Index rows_, columns_, known_ = 0;
  Matrix<S> differences_;  ///< rows columns x orders
  Vector<S> prediction_, next_;
  Matrix<S> sums_;
  std::vector<Index> orders_;
  S least_ = 0, norm_ = 0;
};

}  // namespace hbvm::core
