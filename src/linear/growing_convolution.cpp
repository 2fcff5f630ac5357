#include "linear/growing_convolution.hpp"

#include <algorithm>
#include <utility>

namespace hbvm::core {
namespace {

/// Limbs below those that a convolution counts, for the errors of many terms.
constexpr long guard_limbs = 2;

/// Fewer coefficients are multiplied as quickly one by one.
Index near_for(long limbs) {
  constexpr long few_limbs = 24;
  constexpr Index of_few = 128, of_many = 16;
  return limbs < few_limbs ? of_few : of_many;
}

}  // namespace

GrowingConvolution::GrowingConvolution(Index length, Index from_a, Index from_b)
    : length_(length),
      from_a_(from_a),
      from_b_(from_b),
      near_(near_for((mpfr_working_bits() + AlignedSeries::guard_bits) / limb_bits)),
      sum_(mpfr_working_bits() + limb_bits),
      more_(mpfr_working_bits() + limb_bits) {
  fmpz_poly_init(x_);
  fmpz_poly_init(y_);
  fmpz_poly_init(product_);
  mpz_init(whole_);
  fmpz_init(part_);
}

GrowingConvolution::~GrowingConvolution() {
  if (sums_) _fmpz_vec_clear(sums_, length_);
  fmpz_poly_clear(x_);
  fmpz_poly_clear(y_);
  fmpz_poly_clear(product_);
  mpz_clear(whole_);
  fmpz_clear(part_);
}

GrowingConvolution::GrowingConvolution(GrowingConvolution&& other) noexcept
    : GrowingConvolution(other.length_, other.from_a_, other.from_b_) {
  near_ = other.near_;
  taken_ = other.taken_;
  exponent_ = other.exponent_;
  std::swap(sums_, other.sums_);
}

void GrowingConvolution::set(Mpfr& r, const AlignedSeries& a, const AlignedSeries& b, Index n) {
  const Index m = n - from_a_ - from_b_, last = n - from_b_;
  if (!by_blocks(n)) return set_convolution(r, a, b, n, from_a_, last);
  if (!a.finite_ || !b.finite_) return mpfr_set_nan(raw(r));
  if (!sums_) sums_ = _fmpz_vec_init(length_);
  if (m <= taken_) {
    taken_ = 0;
    _fmpz_vec_zero(sums_, length_);
  }
  const long exponent = a.exponent_ + b.exponent_ - limb_bits * (a.limbs_ + guard_limbs);
  follow(exponent);
  take_blocks(a, b, m);
  // Those with the first few coefficients of either.
  set_convolution(raw(sum_), a, b, n, from_a_, from_a_ + near_ - 1);
  if (&a == &b && from_a_ == from_b_) {
    mpfr_mul_2ui(raw(sum_), raw(sum_), 1, MPFR_RNDN);
  } else {
    set_convolution(raw(more_), a, b, n, last - near_ + 1, last);
    mpfr_add(raw(sum_), raw(sum_), raw(more_), MPFR_RNDN);
  }
  fmpz_get_mpz(whole_, sums_ + m);
  mpfr_set_z_2exp(raw(more_), whole_, exponent_, MPFR_RNDN);
  mpfr_add(raw(r), raw(sum_), raw(more_), MPFR_RNDN);
}

void GrowingConvolution::follow(long exponent) {
  if (taken_ > 0 && exponent > exponent_)
    for (Index m = 0; m < length_; ++m)
      fmpz_tdiv_q_2exp(sums_ + m, sums_ + m, static_cast<ulong>(exponent - exponent_));
  exponent_ = exponent;
}

void GrowingConvolution::take_blocks(const AlignedSeries& a, const AlignedSeries& b, Index m) {
  const bool is_square = &a == &b && from_a_ == from_b_;
  for (Index begin = std::max(2 * near_, taken_ / near_ * near_ + near_); begin <= m; begin += near_)
    for (Index size = near_; begin % size == 0 && begin >= 2 * size; size *= 2) {
      const Index other = begin - size;
      if (is_square) {
        add_block(a, b, size, other, size, other == size ? 1 : 2);
      } else {
        add_block(a, b, size, other, size, 1);
        if (other != size) add_block(a, b, other, size, size, 1);
      }
    }
  taken_ = m;
}

void GrowingConvolution::add_block(const AlignedSeries& a, const AlignedSeries& b, Index i, Index j, Index size,
                                   int times) {
  if (i + j >= length_) return;
  const auto longest = [&](const AlignedSeries& series, Index first) {
    long used = 0;
    for (Index n = first; n < first + size; ++n) used = std::max<long>(used, series.used_[static_cast<std::size_t>(n)]);
    return used;
  };
  // Of the products' limbs those from `lowest` on count. As many of either factor make them, and one more. Where a
  // series has fallen to nothing the sum is to be 0, and not what was left out.
  const long lowest = a.limbs_ - guard_limbs, of_a = longest(a, i + from_a_), of_b = longest(b, j + from_b_);
  const long kept = of_a + of_b - lowest;
  if (kept <= 0) return;
  const long below_a = std::max(of_a - kept - 1, 0L), below_b = std::max(of_b - kept - 1, 0L);
  const auto fill = [&](fmpz_poly_struct* poly, const AlignedSeries& series, Index first, long below) {
    fmpz_poly_zero(poly);
    fmpz_poly_fit_length(poly, size);
    for (Index n = 0; n < size; ++n) {
      const long used = series.used_[static_cast<std::size_t>(first + n)] - below;
      mpz_t view;
      mpz_roinit_n(view, parts_of(series.at(first + n) + below), limb_parts * std::max(used, 0L));
      fmpz_set_mpz(poly->coeffs + n, view);
      if (series.sign_[static_cast<std::size_t>(first + n)] < 0) fmpz_neg(poly->coeffs + n, poly->coeffs + n);
    }
    _fmpz_poly_set_length(poly, size);
    _fmpz_poly_normalise(poly);
  };
  fill(x_, a, i + from_a_, below_a);
  fill(y_, b, j + from_b_, below_b);
  fmpz_poly_mullow(product_, x_, y_, std::min(2 * size - 1, length_ - i - j));
  const auto down = static_cast<ulong>(limb_bits * (lowest - below_a - below_b));
  for (Index n = 0; n < product_->length; ++n) {
    fmpz_tdiv_q_2exp(part_, product_->coeffs + n, down);
    fmpz_addmul_ui(sums_ + i + j + n, part_, static_cast<ulong>(times));
  }
}

}  // namespace hbvm::core
