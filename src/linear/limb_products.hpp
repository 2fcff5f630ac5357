#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "linear/limbs.hpp"

namespace hbvm::core {

/// Products of whole numbers, each of as many limbs, that are added or subtracted.
class LimbProducts {
 public:
  /// x y, whose limbs, lowest first, must stay, times a sign: 1, -1, or 0, which adds nothing.
  struct Signed {
    const Limb *x, *y;
    int sign;
  };
  /// Takes the products that next() returns for n = 0, 1, ... count - 1.
  template <class Next>
  void set(std::size_t count, Next next) {
    if (count + 1 > positive_.size()) {
      positive_.resize(count + 1);
      negative_.resize(count + 1);
    }
    // Signs follow no pattern that a processor could foresee.
    Product* positive = positive_.data();
    Product* negative = negative_.data();
    for (std::size_t n = 0; n < count; ++n) {
      const Signed product = next(n);
      *positive = *negative = {product.x, product.y};
      positive += product.sign > 0 ? 1 : 0;
      negative += product.sign < 0 ? 1 : 0;
    }
    positives_ = static_cast<std::size_t>(positive - positive_.data());
    negatives_ = static_cast<std::size_t>(negative - negative_.data());
  }

  /// sum, in two's complement with limbs + 2 limbs, = the sum of all over b^(limbs - 1), b = 2^limb_bits, without
  /// products of limbs of lower order. Each misses less than `limbs` units of the sum's second limb.
  void set_upper_sum(Limb* sum, long limbs);

 private:
  struct Product {
    const Limb *x, *y;
  };
  using Products = std::span<const Product>;
  template <std::size_t limbs>
  static void set_columns(Limb* sum, Products products);
  static void set_columns(Limb* sum, long limbs, Products products);
  void set_by_parts(Limb* sum, long limbs, Products products);
  void set_one_sign(Limb* sum, long limbs, Products products);

  std::vector<Product> positive_, negative_;
  std::size_t positives_ = 0, negatives_ = 0;
  std::vector<Product> crossed_;
  std::vector<Limb> taken_, scratch_;
};

}  // namespace hbvm::core
