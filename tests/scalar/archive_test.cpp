#include "scalar/archive.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "hbvm/error.hpp"
#include "printing.hpp"
#include "scalar/literal.hpp"

namespace hbvm::core {
namespace {

/// The bits, where == does not tell: of NaN, and of the two zeros.
std::string bits_of(const BigFloat& x) {
  char* text = nullptr;
  mpfr_asprintf(&text, "%ld %Ra", static_cast<long>(mpfr_get_prec(raw(x))), raw(x));
  const std::string result = text;
  mpfr_free_str(text);
  return result;
}

template <class S>
class Remembered : public InDigits<50> {};
TYPED_TEST_SUITE(Remembered, AllScalars, ScalarNames);

TYPED_TEST(Remembered, NumbersHaveTheSameBits) {
  using S = TypeParam;
  const S one = 1, smallest = std::numeric_limits<S>::min() > S(0) ? std::numeric_limits<S>::min() : one;
  std::vector<S> values{S(0),
                        S(-S(0)),
                        one,
                        S(1 - epsilon<S>() / 2),
                        literal<S>("0.1"),
                        literal<S>("-1e300/3"),
                        literal<S>("pi*1e-300"),
                        S(smallest * literal<S>("4/3")),
                        S(smallest / 8),
                        S(one / S(0)),
                        S(-one / S(0)),
                        S(S(0) / S(0))};
  if constexpr (!std::same_as<S, Mpfr>) values.push_back(std::numeric_limits<S>::denorm_min());
  Archive writing;
  writing(values);
  std::vector<S> read(values.size(), S(7));
  Archive reading(writing.text());
  reading(read);
  reading.expect_end();
  for (std::size_t i = 0; i < values.size(); ++i)
    EXPECT_EQ(bits_of(exactly(read[i])), bits_of(exactly(values[i]))) << i;
}

TEST(Archive, KeepsThePrecisionOfEachMpfr) {
  const PrecisionScope digits(40);
  Mpfr coarse = literal<Mpfr>("1/3"), fine = 0;
  {
    const PrecisionScope more(90);
    Mpfr value = literal<Mpfr>("1/7");
    mpfr_set_prec(raw(fine), mpfr_get_prec(raw(value)));
    mpfr_set(raw(fine), raw(value), MPFR_RNDN);
  }
  Archive writing;
  writing(coarse, fine);
  Mpfr a = 0, b = 0;
  Archive reading(writing.text());
  reading(a, b);
  EXPECT_EQ(bits_of(exactly(a)), bits_of(exactly(coarse)));
  EXPECT_EQ(bits_of(exactly(b)), bits_of(exactly(fine)));
}

struct Thing {
  std::string name;
  long count = 0;
  bool flag = false;
  void remember(Archive& archive) { archive(name, count, flag); }
};

TEST(Archive, KeepsTextsCountsAndWhateverRemembers) {
  Thing thing{"two\nlines, and \0 more", -5, true}, empty;
  thing.name += '\0';
  std::uint64_t large = ~std::uint64_t{0};
  int small = -3;
  Archive writing;
  writing(thing, empty, large, small);
  Thing first{"x", 1, false}, second{"y", 2, true};
  std::uint64_t number = 0;
  int other = 0;
  Archive reading(writing.text());
  EXPECT_TRUE(reading.reading());
  reading(first, second, number, other);
  reading.expect_end();
  EXPECT_EQ(first.name, thing.name);
  EXPECT_EQ(first.count, -5);
  EXPECT_TRUE(first.flag);
  EXPECT_EQ(second.name, "");
  EXPECT_FALSE(second.flag);
  EXPECT_EQ(number, large);
  EXPECT_EQ(other, -3);
}

TEST(Archive, RefusesWhatDoesNotFit) {
  Archive writing;
  std::vector<double> two{1, 2};
  writing(two);
  const auto refused = [](const std::string& text, auto value) {
    Archive reading(text);
    EXPECT_THROW(
        {
          reading(value);
          reading.expect_end();
        },
        InputError)
        << text;
  };
  refused(writing.text(), std::vector<double>(3));
  refused(writing.text(), 0L);
  refused("", 0L);
  refused("5", 0L);
  refused("5x\n", 0L);
  refused("1p\n", double{0});
  refused("1.5 \n", double{0});
  refused("0x1.8p+0x\n", Quad(0));
  refused("53\n0x1.000000000000000000001p+0\n", Mpfr(0));
  refused("0\n1\n", Mpfr(0));
  refused("5\nabc\n", std::string());
  refused("3\nabcd", std::string());
  refused("-1\nabc\n", std::string());
}

}  // namespace
}  // namespace hbvm::core
