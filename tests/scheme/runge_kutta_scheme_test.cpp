#include <gtest/gtest.h>

#include "scheme/tables.hpp"

namespace hbvm::core {
namespace {

TEST(RungeKuttaSchemes, HaveTheOrdersOfTheirWeights) {
  const std::vector<MetPart> parts = parts_of(*scheme_of(fehlberg));
  EXPECT_EQ(parts.at(0).order, 5);
  EXPECT_EQ(parts.at(1).name, "embedded order");
  EXPECT_EQ(parts.at(1).order, 4);
  EXPECT_EQ(parts.at(0).each.back().conditions, 20);
  EXPECT_FALSE(parts.at(0).each.back().met);
}

TEST(RungeKuttaSchemes, OfGaussHaveTwiceTheirStages) {
  EXPECT_EQ(order_of("A = [['1/4', '1/4-sqrt(3)/6'], ['1/4+sqrt(3)/6', '1/4']]\nb = ['1/2', '1/2']\n"), 4);
}

/// The cubic of Hermite: theta (1 - 3/2 theta + 2/3 theta^2) and so on for the trapezoidal rule's two slopes.
TEST(RungeKuttaSchemes, HaveAnOrderAtAnyTime) {
  const std::string trapezoidal = "A = [[0,0],['1/2','1/2']]\nb = ['1/2','1/2']\n";
  EXPECT_EQ(order_of(trapezoidal + "b_theta = [[1,'-1/2'],[0,'1/2']]\n", 1), 2);
  EXPECT_EQ(order_of(trapezoidal + "b_theta = [['1/2',0],['1/2',0]]\n", 1), 1);
  EXPECT_EQ(order_of(trapezoidal + "b_theta = [[1,'-1/3'],[0,'1/2']]\n", 1), 0);
}

TEST(RungeKuttaSchemes, HoldNodesAgainstRowSums) {
  const auto digits = [](const std::string& text) {
    const SchemePtr scheme = scheme_of(text);
    const PrecisionScope scope(120);
    return consistent_digits(*scheme, scheme->written_values<Mpfr>());
  };
  EXPECT_GT(digits(fehlberg), 118);
  std::string wrong = fehlberg;
  wrong.replace(wrong.find("12/13"), 5, "12/17");
  EXPECT_NEAR(digits(wrong), 0.66, 0.01);
}

}  // namespace
}  // namespace hbvm::core
