#include "linear/limb_products.hpp"

#include <algorithm>
#include <utility>

namespace hbvm::core {

namespace {

/// A sum of products of limbs.
template <long parts>
class ColumnOf;

/// Each needs three instructions beside the multiplication.
template <>
class ColumnOf<1> {
 public:
  void add(Limb x, Limb y) {
    high_ += static_cast<Limb>(__builtin_add_overflow(low_, static_cast<Double>(x) * y, &low_));
  }
  /// The lowest limb; the others are left for the next column.
  Limb take() {
    const auto lowest = static_cast<Limb>(low_);
    low_ = low_ >> limb_bits | static_cast<Double>(high_) << limb_bits;
    high_ = 0;
    return lowest;
  }

 private:
  __extension__ using Double = unsigned __int128;
  Double low_ = 0;
  Limb high_ = 0;
};

/// Of halves, where a processor multiplies no more. Sums of up to 2^30 halves fit in a limb.
template <>
class ColumnOf<2> {
 public:
  void add(Limb x, Limb y) {
    const Limb x0 = x & half, x1 = x >> bits, y0 = y & half, y1 = y >> bits;
    const Limb low = x0 * y0, first = x0 * y1, second = x1 * y0, high = x1 * y1;
    sums_[0] += low & half;
    sums_[1] += (low >> bits) + (first & half) + (second & half);
    sums_[2] += (first >> bits) + (second >> bits) + (high & half);
    sums_[3] += high >> bits;
  }
  Limb take() {
    const Limb lowest = sums_[0], next = sums_[1] + (lowest >> bits), carry = next >> bits;
    sums_[0] = sums_[2] + carry;
    sums_[1] = sums_[3];
    sums_[2] = sums_[3] = 0;
    return (lowest & half) | next << bits;
  }

 private:
  static constexpr int bits = limb_bits / 2;
  static constexpr Limb half = (Limb{1} << bits) - 1;
  Limb sums_[4] = {};
};

using Column = ColumnOf<limb_parts>;

/// Up to here numbers of each length have a loop of their own.
constexpr std::size_t most_unrolled = 8;
/// From here on the library's whole products of parts are faster than columns.
constexpr long least_by_parts = 16;

}  // namespace

/// Column by column, of all products at once.
template <std::size_t limbs>
void LimbProducts::set_columns(Limb* sum, Products products) {
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

void LimbProducts::set_columns(Limb* sum, long limbs, Products products) {
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
void LimbProducts::set_by_parts(Limb* sum, long limbs, Products products) {
  const long lower = 3 * limbs / 8, upper = limbs - lower, skipped = upper - lower - 1;
  scratch_.resize(static_cast<std::size_t>(2 * upper));
  crossed_.clear();
  std::fill_n(sum, limbs + 2, Limb{0});
  for (const Product& product : products) {
    multiply_limbs(scratch_.data(), product.x + lower, product.y + lower, upper);
    add_limbs(sum, limbs + 2, scratch_.data() + skipped, limbs + 1);
    crossed_.push_back({product.x, product.y + upper});
    crossed_.push_back({product.x + upper, product.y});
  }
  set_columns(scratch_.data(), lower, crossed_);
  add_limbs(sum, limbs + 2, scratch_.data(), lower + 2);
}

void LimbProducts::set_one_sign(Limb* sum, long limbs, Products products) {
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

void LimbProducts::set_upper_sum(Limb* sum, long limbs) {
  set_one_sign(sum, limbs, {positive_.data(), positives_});
  if (negatives_ == 0) return;
  taken_.resize(static_cast<std::size_t>(limbs + 2));
  set_one_sign(taken_.data(), limbs, {negative_.data(), negatives_});
  subtract_limbs(sum, limbs + 2, taken_.data(), limbs + 2);
}

}  // namespace hbvm::core
