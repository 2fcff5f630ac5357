#include "linear/aligned_series.hpp"

#include <algorithm>

#include "linear/limb_products.hpp"
#include "linear/limb_sum.hpp"
#include "scalar/in_place.hpp"

namespace hbvm::core {
namespace {

/// Room above the largest coefficient, so that those that follow may be somewhat larger.
constexpr long headroom = 4;

}  // namespace

AlignedSeries::AlignedSeries(Index length)
    : limbs_((mpfr_working_bits() + guard_bits + limb_bits - 1) / limb_bits),
      digits_(static_cast<std::size_t>(length * limbs_)),
      sign_(static_cast<std::size_t>(length)),
      used_(static_cast<std::size_t>(length)),
      sum_(static_cast<std::size_t>(limbs_ + 2)) {}

void AlignedSeries::count_limbs(Index n) {
  long used = limbs_;
  while (used > 0 && at(n)[used - 1] == 0) --used;
  used_[static_cast<std::size_t>(n)] = static_cast<int>(used);
  if (used == 0) sign_[static_cast<std::size_t>(n)] = 0;
}

void AlignedSeries::shift(Index count, long up) {
  const long whole = std::min(up / limb_bits, limbs_), kept = limbs_ - whole;
  const auto bits = static_cast<unsigned>(up % limb_bits);
  for (Index n = 0; n < count; ++n) {
    Limb* const x = at(n);
    if (whole > 0) {
      std::copy_n(x + whole, kept, x);
      std::fill_n(x + kept, whole, Limb{0});
    }
    if (kept > 0 && bits != 0) shift_limbs_down(x, x, kept, bits);
    count_limbs(n);
  }
}

void AlignedSeries::set(Index n, const Mpfr& a) {
  if (n == 0) empty_ = finite_ = true;
  mpfr_srcptr const x = raw(a);
  if (!mpfr_regular_p(x)) {
    finite_ = finite_ && mpfr_zero_p(x);
  } else if (const long exponent = mpfr_get_exp(x); empty_) {
    exponent_ = exponent + headroom;
    empty_ = false;
  } else if (exponent > exponent_) {
    shift(n, exponent + headroom - exponent_);
    exponent_ = exponent + headroom;
  }
  set_limbs(at(n), limbs_, x, exponent_);
  sign_[static_cast<std::size_t>(n)] = static_cast<signed char>(mpfr_regular_p(x) ? mpfr_sgn(x) : 0);
  count_limbs(n);
}

void set_convolution(mpfr_ptr r, const AlignedSeries& a, const AlignedSeries& b, Index n, Index first, Index last) {
  if (!a.finite_ || !b.finite_) return mpfr_set_nan(r);
  if (first > last) return mpfr_set_zero(r, 1);
  // Of a product of used and used limbs those from limb L - 1 of 2 L on count. As many limbs of either factor make
  // them, but for one if either is as long as can be. The longest product takes that many of all.
  const int L = static_cast<int>(a.limbs_);
  const int* const own = a.used_.data() + first;
  const int* const other = b.used_.data() + n - first;
  int longest = 0;
  for (Index i = 0; i <= last - first; ++i) longest = std::max(longest, own[i] + other[-i]);
  const long limbs = std::max(longest - L, 1);
  static thread_local LimbProducts products;
  const Limb* const x = a.at(first);
  const Limb* const y = b.at(n - first) + (L - limbs);
  const signed char* const sign = &a.sign_[static_cast<std::size_t>(first)];
  const signed char* const other_sign = &b.sign_[static_cast<std::size_t>(n - first)];
  products.set(static_cast<std::size_t>(last - first + 1), [=](std::size_t l) -> LimbProducts::Signed {
    const auto i = static_cast<Index>(l);
    const Index below = std::max<Index>(own[i] - limbs, 0);
    return {x + i * L + below, y - i * L - below, sign[i] * other_sign[-i]};
  });
  Limb* const sum = a.sum_.data();
  products.set_upper_sum(sum, limbs);
  set_limb_sum(r, sum, limbs + 2, a.exponent_ + b.exponent_ - limb_bits * (L - limbs));
}

}  // namespace hbvm::core
