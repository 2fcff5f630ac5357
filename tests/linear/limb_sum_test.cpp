#include "linear/limb_sum.hpp"

#include <array>

#include "printing.hpp"

namespace hbvm::core {
namespace {

/// The sum in two's complement with one limb above the point, against whole numbers in many bits.
TEST(LimbSum, IsRoundedOnce) {
  const PrecisionScope digits(30);
  mpfr_t exact;
  mpfr_init2(exact, 300);
  const auto expect = [&](std::array<mp_limb_t, 3> sum, mpfr_exp_t exponent) {
    const bool negative = sum[2] >> 63 != 0;
    // Of two's complement with three limbs: the whole number less 2^192.
    mpfr_set_ui(exact, sum[2], MPFR_RNDN);
    for (const std::size_t i : {1U, 0U}) {
      mpfr_mul_2ui(exact, exact, 64, MPFR_RNDN);
      mpfr_add_ui(exact, exact, sum[i], MPFR_RNDN);
    }
    if (negative) {
      mpfr_t all;
      mpfr_init2(all, 300);
      mpfr_set_ui_2exp(all, 1, 192, MPFR_RNDN);
      mpfr_sub(exact, exact, all, MPFR_RNDN);
      mpfr_clear(all);
    }
    mpfr_mul_2si(exact, exact, exponent - 128, MPFR_RNDN);
    Mpfr expected, found;
    mpfr_set(raw(expected), exact, MPFR_RNDN);
    set_limb_sum(raw(found), sum.data(), 3, exponent);
    EXPECT_EQ(found, expected) << sum[2] << " " << sum[1] << " " << sum[0];
  };
  constexpr mp_limb_t all = ~mp_limb_t{0};
  expect({1, 2, 3}, 0);
  expect({all, all, 0}, 5);
  expect({0x123456789abcdef0U, 0x0fedcba987654321U, 0}, -70);
  expect({5, 0, 0}, 1000);
  expect({0, 7, 0}, -1000);
  expect({all, all, all}, 0);
  expect({0, 0, all}, 3);
  expect({0x123456789abcdef0U, 77, all - 3}, -3);
  expect({0, 0, 0}, 8);
  mpfr_clear(exact);
}

}  // namespace
}  // namespace hbvm::core
