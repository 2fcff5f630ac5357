#include "lesson/inequality.hpp"

#include "words.hpp"

namespace hbvm::core {
namespace {

Constants numbers(const char* x) {
  Constants all;
  all.insert_or_assign("x", Expression::parse(x));
  return all;
}

TEST(Inequalities, HoldOrNot) {
  for (const auto& [text, below, at, above] : {std::tuple("x < 1/2", true, false, false),
                                               {"x <= 1/2", true, true, false},
                                               {"1/4 <= x/2", false, true, true},
                                               {"sqrt(1/4) < x", false, false, true}}) {
    const Inequality inequality = Inequality::parse(text);
    EXPECT_EQ(inequality.holds(numbers("0.4999999999999999999999")), below) << text;
    EXPECT_EQ(inequality.holds(numbers("0.5")), at) << text;
    EXPECT_EQ(inequality.holds(numbers("0.5000000000000000000001")), above) << text;
  }
}

TEST(Inequalities, SayWhatTheyLack) {
  expect_words(message_of([] { Inequality::parse("x = 1"); }), {"'x = 1'", "A <= B"});
  EXPECT_THROW(Inequality::parse("1 < x < 2"), ExpressionError);
  EXPECT_THROW(Inequality::parse("< x"), ExpressionError);
  expect_words(message_of([] { Inequality::parse("y < 1").holds(numbers("1")); }), {"'y'"});
  EXPECT_THROW(Inequality::parse("1/x < 1").holds(numbers("0")), ExpressionError);
}

}  // namespace
}  // namespace hbvm::core
