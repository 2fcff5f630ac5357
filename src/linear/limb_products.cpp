#include "linear/limb_products.hpp"

#include <algorithm>
#include <utility>

#include "linear/limb_sum.hpp"

namespace hbvm::core {

namespace {

/// A sum of products of limbs: each needs three instructions beside the multiplication.
class Column {
 public:
  void add(mp_limb_t x, mp_limb_t y) {
    high_ += static_cast<mp_limb_t>(__builtin_add_overflow(low_, static_cast<Double>(x) * y, &low_));
  }
  /// The lowest limb; the others are left for the next column.
  mp_limb_t take() {
    const auto lowest = static_cast<mp_limb_t>(low_);
    low_ = low_ >> limb_bits | static_cast<Double>(high_) << limb_bits;
    high_ = 0;
    return lowest;
  }

 private:
  __extension__ using Double = unsigned __int128;
  Double low_ = 0;
  mp_limb_t high_ = 0;
};

/// Up to here numbers of each length have a loop of their own.
constexpr std::size_t most_unrolled = 8;
/// From here on the library's whole products of parts are faster than columns.
constexpr long least_by_parts = 16;

}  // namespace

/// Column by column, of all products at once.
template <std::size_t limbs>
void LimbProducts::set_columns(mp_limb_t* sum, Products products) {
  Column column;
  const auto add = [&]<std::size_t lowest, std::size_t... j>(std::integral_constant<std::size_t, lowest>,
                                                             std::index_sequence<j...>) {
    for (const Product& product : products) (column.add(product.x[lowest + j], product.y[limbs - 1 - j]), ...);
    sum[lowest] = column.take();
  };
  [&]<std::size_t... lowest>(std::index_sequence<lowest...>) {
    (add(std::integral_constant<std::size_t, lowest>(), std::make_index_sequence<limbs - lowest>()), ...);
  }
  (std::make_index_sequence<limbs>());
  sum[limbs] = column.take();
  sum[limbs + 1] = column.take();
}

void LimbProducts::set_columns(mp_limb_t* sum, long limbs, Products products) {
  Column column;
  for (long lowest = 0; lowest < limbs; ++lowest) {
    for (const Product& product : products)
      for (long j = 0; j < limbs - lowest; ++j) column.add(product.x[lowest + j], product.y[limbs - 1 - j]);
    sum[lowest] = column.take();
  }
  sum[limbs] = column.take();
  sum[limbs + 1] = column.take();
}

/// The upper parts of both factors wholly; of either's lower m limbs only the m highest of the other reach so far up
/// (Mulders, Appl. Algebra Eng. Commun. Comput. 11, 2000).
void LimbProducts::set_by_parts(mp_limb_t* sum, long limbs, Products products) {
  const long lower = 3 * limbs / 8, upper = limbs - lower, skipped = upper - lower - 1;
  scratch_.resize(static_cast<std::size_t>(2 * upper));
  crossed_.clear();
  std::fill_n(sum, limbs + 2, mp_limb_t{0});
  for (const Product& product : products) {
    mpn_mul_n(scratch_.data(), product.x + lower, product.y + lower, upper);
    mpn_add(sum, sum, limbs + 2, scratch_.data() + skipped, limbs + 1);
    crossed_.push_back({product.x, product.y + upper});
    crossed_.push_back({product.x + upper, product.y});
  }
  set_columns(scratch_.data(), lower, crossed_);
  mpn_add(sum, sum, limbs + 2, scratch_.data(), lower + 2);
}

void LimbProducts::set_one_sign(mp_limb_t* sum, long limbs, Products products) {
  const bool unrolled = [&]<std::size_t... n>(std::index_sequence<n...>) {
    return ((limbs == static_cast<long>(n + 1) && (set_columns<n + 1>(sum, products), true)) || ...);
  }
  (std::make_index_sequence<most_unrolled>());
  if (unrolled) return;
  if (limbs < least_by_parts)
    set_columns(sum, limbs, products);
  else
    set_by_parts(sum, limbs, products);
}

void LimbProducts::set_upper_sum(mp_limb_t* sum, long limbs) {
  set_one_sign(sum, limbs, {positive_.data(), positives_});
  if (negatives_ == 0) return;
  taken_.resize(static_cast<std::size_t>(limbs + 2));
  set_one_sign(taken_.data(), limbs, {negative_.data(), negatives_});
  mpn_sub_n(sum, sum, taken_.data(), limbs + 2);
}

}  // namespace hbvm::core
