#pragma once

#include <vector>

#include "linear/limbs.hpp"
#include "linear/matrix.hpp"

namespace hbvm::core {

/// The coefficients of a power series as whole multiples of one unit, far below the last digit of the largest. Where
/// they fall, the later ones are shorter numbers. A convolution multiplies of each pair only what counts beside the
/// largest. Of a series that falls to round-off it does a sixth to a third of what rounded numbers take.
///
/// Errors are those of rounding every coefficient of l limbs to l 2^-(bits + guard_bits) of the largest so far. What is
/// small beside the others counts as much as they do where the series is summed.
class AlignedSeries {
 public:
  static constexpr int guard_bits = 24;

  /// A series of `length` coefficients in the digits of the scope.
  explicit AlignedSeries(Index length);

  /// Coefficient n; those before it are set. Coefficient 0 begins a new series.
  void set(Index n, const Mpfr& a);

  friend void set_convolution(mpfr_ptr r, const AlignedSeries& a, const AlignedSeries& b, Index n, Index first,
                              Index last);
  friend class GrowingConvolution;

 private:
  Limb* at(Index n) { return &digits_[static_cast<std::size_t>(n * limbs_)]; }
  const Limb* at(Index n) const { return &digits_[static_cast<std::size_t>(n * limbs_)]; }
  /// Takes a larger unit: 2^up as large.
  void shift(Index count, long up);
  void count_limbs(Index n);

  long limbs_, exponent_ = 0;          ///< coefficients are below 2^exponent_
  bool empty_ = true, finite_ = true;  ///< all are 0 so far; all are numbers
  std::vector<Limb> digits_;           ///< lowest first
  std::vector<signed char> sign_;
  std::vector<int> used_;          ///< limbs up to the highest that is not 0
  mutable std::vector<Limb> sum_;  ///< scratch of a convolution with this as its first factor
};

/// r = sum_{first <= i <= last} a_i b_{n-i}, for series of the same digits; NaN if one has a coefficient that is not
/// finite.
void set_convolution(mpfr_ptr r, const AlignedSeries& a, const AlignedSeries& b, Index n, Index first, Index last);
inline void set_convolution(Mpfr& r, const AlignedSeries& a, const AlignedSeries& b, Index n, Index first, Index last) {
  set_convolution(raw(r), a, b, n, first, last);
}

}  // namespace hbvm::core
