#include <gtest/gtest.h>

#include "hbvm/error.hpp"
#include "scheme/tables.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

TEST(SplittingSchemes, HaveTheOrdersOfTheirWords) {
  EXPECT_EQ(order_of("a = ['1/2','1/2']\nb = [1]\n"), 2);
  EXPECT_EQ(order_of("a = [1]\nb = [1]\n"), 1);
  EXPECT_EQ(order_of(forest_ruth), 4);
  std::string wrong = forest_ruth;  // the sign of Ruth's middle kick
  wrong.replace(wrong.find("'-2^(1/3)"), 9, "'2^(1/3)");
  EXPECT_EQ(order_of(wrong), 0);
}

/// R. McLachlan and P. Atela, 1992: order 4 with four kicks for q'' = f(q) alone.
TEST(SplittingSchemes, MayHaveAHigherOrderForAccelerations) {
  const std::string mclachlan =
      "family = 'splitting'\ndigits = 16\n"
      "a = [0.5153528374311229, -0.0857820194129737, 0.4415830236164665, 0.1288461583653842]\n"
      "b = [0.1344961992774311, -0.2248198030794208, 0.7563200005156683, 0.3340036032863215]\n";
  const std::vector<MetPart> either = parts_of(*scheme_of(mclachlan), 16);
  const std::string kicks_first =
      "family = 'splitting'\ndigits = 16\n"
      "a = [0.5153528374311229, -0.0857820194129737, 0.4415830236164665, 0.1288461583653842]\n"
      "b = [0.1344961992774311, -0.2248198030794208, 0.7563200005156683, 0.3340036032863215, 0]\n";
  const std::vector<MetPart> parts = parts_of(*scheme_of(kicks_first), 16);
  EXPECT_EQ(std::max(either.at(1).order, parts.at(1).order), 4);
  EXPECT_LT(std::max(either.at(0).order, parts.at(0).order), 4);
}

TEST(SplittingSchemes, ActInTurn) {
  expect_words(message_of([] { scheme_of("a = [1,2,3]\nb = [1]\n"); }), {"act in turn"});
}

}  // namespace
}  // namespace hbvm::core
