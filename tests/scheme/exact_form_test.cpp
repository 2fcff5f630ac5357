#include "scheme/exact_form.hpp"

#include <gtest/gtest.h>

#include "scalar/literal.hpp"

namespace hbvm::core {
namespace {

TEST(ExactForms, AreFractionsAndRoots) {
  const PrecisionScope scope(60);
  for (const char* const text : {"0", "-3544/2565", "7", "1/3", "-28561/56430", "sqrt(2)", "-sqrt(5)/7",
                                 "(3 - sqrt(3))/6", "(2 + 3*sqrt(10))/8", "1 - sqrt(2)"})
    EXPECT_EQ(exact_form(literal<Mpfr>(text), 40), text);
  EXPECT_EQ(exact_form(literal<Mpfr>("2^(1/3)"), 40), "");
  EXPECT_EQ(exact_form(literal<Mpfr>("pi"), 40), "");
}

/// Of few digits nothing is said that they do not show.
TEST(ExactForms, NeedMoreDigitsThanTheyHave) {
  const PrecisionScope scope(60);
  EXPECT_EQ(exact_form(literal<Mpfr>("0.333333333333"), 12), "1/3");
  EXPECT_EQ(exact_form(literal<Mpfr>("0.2357022603955"), 12), "sqrt(2)/6");
  EXPECT_EQ(exact_form(literal<Mpfr>("0.2357022603955"), 7), "");
  EXPECT_EQ(exact_form(literal<Mpfr>("0.74682413281"), 11), "");
}

}  // namespace
}  // namespace hbvm::core
