#pragma once

#include <vector>

#include "hbvm/linear/constant_count.hpp"
#include "hbvm/linear/matrix.hpp"
#include "hbvm/linear/operation_counts.hpp"
#include "hbvm/scalar/archive.hpp"
#include "hbvm/scalar/binary_exponent.hpp"
#include "hbvm/scalar/in_place.hpp"

namespace hbvm {

/// Continues a sequence x_1, x_2, … of matrices, one a step, column by column by the polynomial through the last
/// elements. It keeps the backward differences D_r = nabla^r x_n; x_{n+1} is predicted as sum_{i <= r} D_i, and as
/// D_{r+1} is the error that the same prediction of x_n had, r is chosen to make that least. Each column has an r of
/// its own, as columns are coordinates or multipliers of different size and unit.
template <Scalar S>
class Extrapolation {
 public:
  static constexpr Index max_order = 8;

  Extrapolation(Index rows, Index columns)
      : rows_(rows),
        size_(rows * columns),
        differences_(size_, max_order + 2),
        scratch_(size_),
        orders_(static_cast<std::size_t>(columns)) {}

  void clear() { known_ = 0; }
  bool empty() const { return known_ == 0; }

  /// x_{n+1} = x.
  void add(const S* x) {
    for (Index i = 0; i < size_; ++i) set(scratch_[i], x[i]);
    const Index differences = std::min(known_ + 1, max_order + 2);
    for (Index r = 0; r < differences; ++r) {
      S* __restrict const old = differences_.data() + r * size_;
      S* __restrict const next = scratch_.data();
      for (Index i = 0; i < size_; ++i) {
        if constexpr (std::same_as<S, Mpfr>) {
          swap(old[i], next[i]);  // Boost's own, which exchanges the digits; the moves of std::swap may round them
          set_difference(next[i], old[i], next[i]);
        } else {
          const S now = next[i];
          next[i] = now - old[i];
          old[i] = now;
        }
      }
    }
    known_ = differences;
    choose_orders();
  }

  /// The prediction of x_{n+1}; not for an empty sequence.
  void predict(S* x) const {
    for (Index i = 0; i < size_; ++i) set(x[i], differences_.data()[i]);
    with_constant_count<S>(rows_, [&](auto rows) {
      for (std::size_t column = 0; column < orders_.size(); ++column, x += rows) {
        const S* difference = differences_.data() + static_cast<Index>(column) * rows;
        for (Index r = 1; r <= orders_[column]; ++r) {
          difference += size_;
          for (Index i = 0; i < rows; ++i) set_sum(x[i], x[i], difference[i]);
        }
      }
    });
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
    counts.add(Op::add, max_order * size_);
    counts.add(Op::subtract, (max_order + 1) * size_);
    return counts;
  }
  Index order(Index column) const { return orders_[static_cast<std::size_t>(column)]; }

  void remember(Archive& archive) {
    archive(known_, orders_);
    for (Index i = 0; i < known_ * size_; ++i) archive(differences_.data()[i]);
  }

 private:
  void choose_orders() {
    if (known_ < 2) {
      for (Index& order : orders_) order = 0;
      return;
    }
    with_constant_count<S>(rows_, [&](auto rows) {
      HeldScratch<S> least = least_, norm = norm_;
      const S* column = differences_.data() + size_;
      for (Index& order : orders_) {
        const S* difference = column;
        set_norm(rows, least, difference);
        Index best = 1;
        for (Index r = 2; r < known_; ++r) {
          difference += size_;
          set_norm(rows, norm, difference);
          best = by_chance(is_greater(least, norm)) ? r : best;
          lower_finite(least, norm);
        }
        order = best - 1;
        column += rows;
      }
    });
  }
  template <class Rows>
  static void set_norm(Rows rows, S& norm, const S* x) {
    set_magnitude(norm, x[0]);
    for (Index i = 1; i < rows; ++i) raise_finite(norm, x[i]);
  }

  Index rows_, size_, known_ = 0;
  Matrix<S> differences_;
  Vector<S> scratch_;
  std::vector<Index> orders_;
  S least_ = 0, norm_ = 0;
};

}  // namespace hbvm
