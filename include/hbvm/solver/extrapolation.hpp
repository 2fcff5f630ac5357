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
        orders_(static_cast<std::size_t>(columns)),
        least_(static_cast<std::size_t>(columns), S(0)) {}

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
    for (Index& order : orders_) order = 0;
    with_constant_count<S>(rows_, [&](auto rows) {
      const S* difference = differences_.data() + size_;
      S* __restrict const least = least_.data();
      Index* __restrict const orders = orders_.data();
      const std::size_t columns = orders_.size();
      HeldScratch<S> norm = norm_;
      for (Index r = 1; r < known_; ++r)
        for (std::size_t column = 0; column < columns; ++column, difference += rows) {
          set_zero(norm);
          for (Index i = 0; i < rows; ++i) raise_magnitude(norm, difference[i]);
          const bool better = r == 1 || exceeds(least[column], norm);
          if constexpr (std::same_as<S, Mpfr>) {
            if (better) set(least[column], norm);
          } else {
            // Either way, as which of them is less is no more than chance: no branch could be foreseen.
            least[column] = better ? norm : least[column];
          }
          orders[column] = better ? r - 1 : orders[column];
        }
    });
  }

  Index rows_, size_, known_ = 0;
  Matrix<S> differences_;
  Vector<S> scratch_;
  std::vector<Index> orders_;
  std::vector<S> least_;  // of the differences, by column
  S norm_ = 0;
};

}  // namespace hbvm
