#include "scalar/mpfr.hpp"

#include <cmath>
#include <concepts>
#include <functional>
#include <stdexcept>
#include <thread>

#include "printing.hpp"
#include "scalar/quad.hpp"

namespace hbvm::core {
namespace {

long bits_of(const Mpfr& x) { return mpfr_get_prec(raw(x)); }

TEST(PrecisionScope, NewValuesCarryItsDigits) {
  for (const unsigned digits : {20u, 50u, 1'000u}) {
    const PrecisionScope scope(digits);
    const Mpfr x = 1;
    EXPECT_EQ(Mpfr::thread_default_precision(), digits);
    EXPECT_EQ(bits_of(x), mpfr_working_bits());
    EXPECT_GE(bits_of(x), std::ceil(digits * std::log2(10.0)));
    EXPECT_LT(bits_of(x), std::ceil(digits * std::log2(10.0)) + 4);
  }
}

TEST(PrecisionScope, NestsAndRestores) {
  const unsigned before = Mpfr::thread_default_precision();
  {
    const PrecisionScope outer(50);
    {
      const PrecisionScope inner(100);
      const PrecisionScope innermost(25);
      EXPECT_EQ(Mpfr::thread_default_precision(), 25u);
    }
    EXPECT_EQ(Mpfr::thread_default_precision(), 50u);
  }
  EXPECT_EQ(Mpfr::thread_default_precision(), before);
}

TEST(PrecisionScope, RestoresTheOptions) {
  const auto before = Mpfr::thread_default_variable_precision_options();
  { const PrecisionScope scope(50); }
  EXPECT_EQ(Mpfr::thread_default_variable_precision_options(), before);
}

TEST(PrecisionScope, RestoresWhenAnExceptionLeavesIt) {
  const PrecisionScope outer(50);
  try {
    const PrecisionScope inner(100);
    throw std::runtime_error("out");
  } catch (const std::runtime_error&) {
  }
  EXPECT_EQ(Mpfr::thread_default_precision(), 50u);
}

TEST(PrecisionScope, AssignmentKeepsTheDigitsOfItsTarget) {
  const PrecisionScope outer(50);
  Mpfr copied = 1, moved = 1;
  const long bits = bits_of(copied);
  {
    const PrecisionScope inner(100);
    const Mpfr third = Mpfr(1) / 3;
    ASSERT_GT(bits_of(third), bits);
    copied = third;
    moved = third * 1;
  }
  EXPECT_EQ(bits_of(copied), bits);
  EXPECT_EQ(bits_of(moved), bits);
  EXPECT_EQ(copied, Mpfr(1) / 3);
}

TEST(PrecisionScope, ResultsOfOperatorsHaveItsDigits) {
  const PrecisionScope scope(70);
  const Mpfr a = 2, b = 3;
  const long bits = mpfr_working_bits();
  EXPECT_EQ(bits_of(a + b), bits);
  EXPECT_EQ(bits_of(a / b), bits);
  EXPECT_EQ(bits_of(a / 3), bits);
  EXPECT_EQ(bits_of(sqrt(a)), bits);
}

TEST(PrecisionScope, ANewThreadNeedsItsOwn) {
  const PrecisionScope scope(77);
  unsigned inherited = 0, own = 0;
  std::thread([&] {
    inherited = Mpfr::thread_default_precision();
    const PrecisionScope inner(123);
    own = Mpfr::thread_default_precision();
  }).join();
  EXPECT_NE(inherited, 77u);
  EXPECT_EQ(own, 123u);
  EXPECT_EQ(Mpfr::thread_default_precision(), 77u);
}

/// How many of these operations take an A and a B.
template <class A, class B, class... Operation>
constexpr int count = (0 + ... + static_cast<int>(std::invocable<Operation, const A&, const B&>));
template <class A, class B>
constexpr int calculations = count<A, B, std::plus<>, std::minus<>, std::multiplies<>, std::divides<>>;
template <class A, class B>
constexpr int comparisons = count<A, B, std::less<>, std::greater<>, std::less_equal<>, std::greater_equal<>>;
template <class A, class B>
concept Operates = calculations<A, B>
+ comparisons<A, B> + calculations<B, A> + comparisons<B, A> > 0;
template <class A, class B>
concept OperatesInEveryWay = calculations<A, B>
== 4 && comparisons<A, B> == 4;

static_assert(!Operates<Mpfr, double> && !Operates<Mpfr, float> && !Operates<Mpfr, long double>);
static_assert(!Operates<Quad, double> && !Operates<Quad, float> && !Operates<Quad, long double>);
static_assert(calculations<Mpfr, Quad> == 0);
static_assert(OperatesInEveryWay<Mpfr, Mpfr> && OperatesInEveryWay<Mpfr, int> && OperatesInEveryWay<int, Mpfr>);
static_assert(OperatesInEveryWay<Quad, Quad> && OperatesInEveryWay<Quad, int> && OperatesInEveryWay<int, Quad>);
static_assert(OperatesInEveryWay<Mpfr, long> && OperatesInEveryWay<Mpfr, unsigned>);

template <class Number, class Binary>
constexpr bool updates_with = requires(Number& x, Binary y) {
  x += y;
}
|| requires(Number& x, Binary y) { x -= y; }
|| requires(Number& x, Binary y) { x *= y; }
|| requires(Number& x, Binary y) { x /= y; };

template <class Number>
class ManyDigits : public ::testing::Test {};
using ManyDigitsTypes = ::testing::Types<Quad, Mpfr>;
TYPED_TEST_SUITE(ManyDigits, ManyDigitsTypes, ScalarNames);

TYPED_TEST(ManyDigits, CannotBeUpdatedWithBinaryLiterals) {
  EXPECT_FALSE((updates_with<TypeParam, float>));
  EXPECT_FALSE((updates_with<TypeParam, double>));
  EXPECT_FALSE((updates_with<TypeParam, long double>));
}

TYPED_TEST(ManyDigits, CanBeUpdatedWithWholeNumbersAndThemselves) {
  EXPECT_TRUE((updates_with<TypeParam, int>));
  EXPECT_TRUE((updates_with<TypeParam, TypeParam>));
}

}  // namespace
}  // namespace hbvm::core
