#include "linear/limb_products.hpp"

#include <random>
#include <vector>

#include "linear/limb_sum.hpp"
#include "printing.hpp"

namespace hbvm::core {
namespace {

/// Sums of whole products, by GMP: a product may miss `limbs` units of the second limb.
TEST(LimbProducts, AreTheUpperHalfOfTheirSum) {
  std::mt19937_64 random(20261123);
  for (const long limbs : {1L, 2L, 3L, 5L, 8L, 9L, 14L, 15L, 16L, 17L, 23L, 24L, 53L})
    for (const std::size_t count : {0U, 1U, 2U, 40U}) {
      const auto length = static_cast<std::size_t>(limbs);
      std::vector<mp_limb_t> x(count * length), y(count * length);
      for (mp_limb_t& digit : x) digit = random();
      // The largest there are, so that every carry there may be is one.
      for (mp_limb_t& digit : y) digit = count == 2 ? ~mp_limb_t{0} : random();
      std::vector<int> signs(count);
      for (int& sign : signs) sign = count == 2 ? 1 : static_cast<int>(random() % 3) - 1;
      LimbProducts products;
      products.set(count, [&](std::size_t n) -> LimbProducts::Signed {
        return {&x[n * length], &y[n * length], signs[n]};
      });
      std::vector<mp_limb_t> sum(length + 2), exact(2 * length + 1), product(2 * length);
      products.set_upper_sum(sum.data(), limbs);
      for (std::size_t n = 0; n < count; ++n) {
        mpn_mul_n(product.data(), &x[n * length], &y[n * length], limbs);
        if (signs[n] > 0) mpn_add(exact.data(), exact.data(), 2 * limbs + 1, product.data(), 2 * limbs);
        if (signs[n] < 0) mpn_sub(exact.data(), exact.data(), 2 * limbs + 1, product.data(), 2 * limbs);
      }
      // Limb limbs - 1 of the exact sum is limb 0 here; the difference, in two's complement, is a small number.
      std::vector<mp_limb_t> difference(length + 2);
      mpn_sub_n(difference.data(), exact.data() + limbs - 1, sum.data(), limbs + 2);
      const auto off = static_cast<long>(difference[1]);
      const mp_limb_t extension = off < 0 ? ~mp_limb_t{0} : 0;
      for (std::size_t i = 2; i < difference.size(); ++i)
        EXPECT_EQ(difference[i], extension) << limbs << " " << count << " " << i;
      EXPECT_LE(std::abs(off), static_cast<long>(count) * limbs + 1) << limbs << " " << count;
    }
}

/// One after the other: nothing is left of those before.
TEST(LimbProducts, BeginAnew) {
  const std::vector<mp_limb_t> x{1, 2, 3}, y{4, 5, 6};
  LimbProducts products;
  std::vector<mp_limb_t> sum(5), again(5);
  const auto one = [&](int sign) {
    return [&, sign](std::size_t) -> LimbProducts::Signed { return {x.data(), y.data(), sign}; };
  };
  products.set(1, one(1));
  products.set_upper_sum(sum.data(), 3);
  products.set(7, one(-1));
  products.set_upper_sum(again.data(), 3);
  products.set(1, one(1));
  products.set_upper_sum(again.data(), 3);
  EXPECT_EQ(sum, again);
  // 3 4 + 2 5 + 1 6, 3 5 + 2 6, 3 6
  EXPECT_EQ(sum, (std::vector<mp_limb_t>{28, 27, 18, 0, 0}));
}

}  // namespace
}  // namespace hbvm::core
