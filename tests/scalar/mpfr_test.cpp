#include "scalar/mpfr.hpp"

#include <cmath>
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

template <class A, class B>
concept Adds = requires(const A& a, const B& b) {
  a + b;
};
template <class A, class B>
concept Subtracts = requires(const A& a, const B& b) {
  a - b;
};
template <class A, class B>
concept Multiplies = requires(const A& a, const B& b) {
  a* b;
};
template <class A, class B>
concept Divides = requires(const A& a, const B& b) {
  a / b;
};
template <class A, class B>
concept Compares = requires(const A& a, const B& b) {
  a < b;
}
|| requires(const A& a, const B& b) { a > b; }
|| requires(const A& a, const B& b) { a <= b; }
|| requires(const A& a, const B& b) { a >= b; };
template <class A, class B>
concept OperatesOneWay = Adds<A, B> || Subtracts<A, B> || Multiplies<A, B> || Divides<A, B> || Compares<A, B>;
template <class A, class B>
concept Operates = OperatesOneWay<A, B> || OperatesOneWay<B, A>;
template <class A, class B>
concept OperatesInEveryWay = Adds<A, B> && Subtracts<A, B> && Multiplies<A, B> && Divides<A, B> && Compares<A, B>;

static_assert(!Operates<Mpfr, double> && !Operates<Mpfr, float> && !Operates<Mpfr, long double>);
static_assert(!Operates<Quad, double> && !Operates<Quad, float> && !Operates<Quad, long double>);
static_assert(!Adds<Mpfr, Quad> && !Subtracts<Mpfr, Quad> && !Multiplies<Mpfr, Quad> && !Divides<Mpfr, Quad>);
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
