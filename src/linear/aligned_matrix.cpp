#include "linear/aligned_matrix.hpp"

#include <algorithm>
#include <limits>

#include "linear/limb_products.hpp"
#include "linear/limb_sum.hpp"

namespace hbvm::core {
namespace {

constexpr long no_exponent = std::numeric_limits<long>::min();

/// The greatest exponent of n numbers of so many bits; no_exponent if all are 0. \return false if one is not finite
bool find_exponent(const Mpfr* x, Index stride, Index n, long bits, long& exponent) {
  exponent = no_exponent;
  for (Index i = 0; i < n; ++i) {
    mpfr_srcptr const a = raw(x[i * stride]);
    if (mpfr_regular_p(a)) {
      if (mpfr_get_prec(a) != bits) return false;
      exponent = std::max(exponent, mpfr_get_exp(a));
    } else if (!mpfr_zero_p(a)) {
      return false;
    }
  }
  return true;
}

signed char sign_of(mpfr_srcptr x) { return static_cast<signed char>(mpfr_sgn(x)); }

}  // namespace

AlignedMatrix::AlignedMatrix(const Matrix<Mpfr>& a) : rows_(a.rows()), columns_(a.cols()), bits_(mpfr_working_bits()) {
  limbs_ = (bits_ + guard_bits + limb_bits - 1) / limb_bits;
  if (limbs_ > max_limbs || !find_exponent(a.data(), 1, a.size(), bits_, exponent_)) {
    limbs_ = 0;
    return;
  }
  entries_.resize(static_cast<std::size_t>(a.size() * limbs_));
  signs_.resize(static_cast<std::size_t>(a.size()));
  for (Index i = 0, n = 0; i < rows_; ++i)
    for (Index j = 0; j < columns_; ++j, ++n) {
      signs_[static_cast<std::size_t>(n)] = sign_of(raw(a(i, j)));
      set_limbs(&entries_[static_cast<std::size_t>(n * limbs_)], limbs_, raw(a(i, j)), exponent_);
    }
  x_.resize(static_cast<std::size_t>(columns_ * limbs_));
  x_signs_.resize(static_cast<std::size_t>(columns_));
  sum_.resize(static_cast<std::size_t>(limbs_ + 2));
}

bool AlignedMatrix::times(Mpfr* r, const Mpfr* x, Index stride) {
  if (limbs_ == 0) return false;
  long x_exponent = 0;
  if (!find_exponent(x, stride, columns_, bits_, x_exponent)) return false;
  if (x_exponent == no_exponent || exponent_ == no_exponent) {
    for (Index i = 0; i < rows_; ++i) mpfr_set_zero(raw(r[i]), 1);
    return true;
  }
  for (Index l = 0; l < columns_; ++l) {
    x_signs_[static_cast<std::size_t>(l)] = sign_of(raw(x[l * stride]));
    set_limbs(&x_[static_cast<std::size_t>(l * limbs_)], limbs_, raw(x[l * stride]), x_exponent);
  }
  static thread_local LimbProducts products;
  const Limb* entry = entries_.data();
  const signed char* sign = signs_.data();
  const signed char* const x_sign = x_signs_.data();
  const Limb* const factors = x_.data();
  const auto columns = static_cast<std::size_t>(columns_), limbs = static_cast<std::size_t>(limbs_);
  for (Index i = 0; i < rows_; ++i, entry += columns_ * limbs_, sign += columns_) {
    products.set(columns, [=](std::size_t l) -> LimbProducts::Signed {
      return {entry + l * limbs, factors + l * limbs, sign[l] * x_sign[l]};
    });
    products.set_upper_sum(sum_.data(), limbs_);
    set_limb_sum(raw(r[i]), sum_.data(), limbs_ + 2, exponent_ + x_exponent);
  }
  return true;
}

}  // namespace hbvm::core
