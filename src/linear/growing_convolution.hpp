#pragma once

#include <flint/fmpz_poly.h>

#include "linear/aligned_series.hpp"
#include "scalar/big_float.hpp"

namespace hbvm::core {

/// The convolution of two series that become known coefficient by coefficient, as those of a recurrence do. Products of
/// whole blocks of coefficients are made ahead, as soon as both are known. They are fast products of polynomials of
/// whole numbers (van der Hoeven, Relax, but don't be too lazy, 2002). Each coefficient then takes few of its own.
///
/// With A_i = a_{i + from_a}, B_j = b_{j + from_b} it is C_m = sum_{i + j = m} A_i B_j. When C_m is asked for, A and B
/// are known up to m. Pairs with an index below `near` are taken for each C_m. The others are in blocks of the sizes
/// s = near, 2 near, 4 near and so on. One factor of a block goes from s to 2s, the other from l s to (l + 1) s. That
/// is A with B for l >= 1, and for l >= 2 also B with A.
class GrowingConvolution {
 public:
  /// Of series of `length` coefficients in the digits of the scope.
  GrowingConvolution(Index length, Index from_a, Index from_b);
  ~GrowingConvolution();
  GrowingConvolution(GrowingConvolution&& other) noexcept;
  GrowingConvolution& operator=(GrowingConvolution&&) = delete;

  /// Whether blocks make it quicker: not for the first few n.
  bool by_blocks(Index n) const { return n - from_a_ - from_b_ >= 2 * near_; }
  /// r = sum_{i >= from_a, n - i >= from_b} a_i b_{n-i}. It is asked for with one n after another, those by blocks at
  /// least; the first of these begins new series. The series are the same from then on; they may be one.
  void set(Mpfr& r, const AlignedSeries& a, const AlignedSeries& b, Index n);

 private:
  /// Products of all blocks that are needed from C_m on.
  void take_blocks(const AlignedSeries& a, const AlignedSeries& b, Index m);
  /// A from i and B from j on, `size` each, so many times.
  void add_block(const AlignedSeries& a, const AlignedSeries& b, Index i, Index j, Index size, int times);
  /// Follows a series that takes a larger unit.
  void follow(long exponent);

  Index length_, from_a_, from_b_, near_;
  Index taken_ = 0;       ///< blocks are made for C up to this
  long exponent_ = 0;     ///< sums are in units of 2^exponent_
  fmpz* sums_ = nullptr;  ///< of blocks, for each C
  fmpz_poly_t x_, y_, product_;
  mpz_t whole_;
  fmpz_t part_;
  BigFloat sum_, more_;
};

}  // namespace hbvm::core
