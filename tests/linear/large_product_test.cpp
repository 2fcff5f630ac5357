#include "linear/large_product.hpp"

#include <gtest/gtest.h>

#include "linear/product.hpp"
#include "printing.hpp"
#include "scalar/random_values.hpp"

namespace hbvm::core {
namespace {

/// As the product term by term has it, in sizes of every kind and with entries that fall.
TEST(LargeProduct, IsTheProduct) {
  for (const unsigned digits : {30U, 300U}) {
    const PrecisionScope scope(digits);
    RandomValues<Mpfr> random(digits);
    for (const auto& [n, l, m] : {std::tuple(1, 1, 1), {3, 7, 2}, {50, 61, 45}}) {
      Matrix<Mpfr> a(n, l), b(l, m), expected;
      for (Index i = 0; i < a.size(); ++i) a.data()[i] = random.value() / (1 + i % 9);
      for (Index i = 0; i < b.size(); ++i) b.data()[i] = i % 5 == 0 ? Mpfr(0) : Mpfr(random.value());
      product<Mpfr>(expected, a, b);
      const Matrix<Mpfr> found = large_product(a, b);
      ASSERT_EQ(found.rows(), n);
      ASSERT_EQ(found.cols(), m);
      EXPECT_LE(max_norm(Matrix<Mpfr>(found - expected)), 100 * epsilon<Mpfr>() * l) << digits << " " << n;
    }
  }
}

}  // namespace
}  // namespace hbvm::core
