#include "method/hbvm_name.hpp"

#include <gtest/gtest.h>

#include "hbvm/error.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

TEST(HbvmName, ReadsKAndS) {
  const HbvmName name = HbvmName::parse("hbvm:5,3");
  EXPECT_EQ(name.k, 5);
  EXPECT_EQ(name.s, 3);
  EXPECT_FALSE(name.is_auto());
}

TEST(HbvmName, ReadsAuto) {
  const HbvmName name = HbvmName::parse("hbvm:auto,3");
  EXPECT_TRUE(name.is_auto());
  EXPECT_EQ(name.s, 3);
}

TEST(HbvmName, ReadsTheNodesOfConstraints) {
  EXPECT_EQ(HbvmName::parse("hbvm:5,3,7"), (HbvmName{5, 3, 7}));
  EXPECT_EQ(HbvmName::parse("hbvm:auto,3,3"), (HbvmName{0, 3, 3}));
  EXPECT_EQ(HbvmName::parse("hbvm:5,3").r, 0) << "left to the constraints";
}

TEST(HbvmName, TextReadsBack) {
  for (const char* text : {"hbvm:1,1", "hbvm:5,3", "hbvm:1000,200", "hbvm:auto,1", "hbvm:auto,200", "hbvm:5,3,3",
                           "hbvm:3,3,1000", "hbvm:auto,2,9"}) {
    EXPECT_EQ(HbvmName::parse(text).text(), text);
    EXPECT_EQ(HbvmName::parse(HbvmName::parse(text).text()), HbvmName::parse(text));
  }
}

TEST(HbvmName, LimitsAreInclusive) {
  for (const HbvmName& name : {HbvmName{1, 1}, {max_k, max_s}, {0, max_s}, {3, 3, 3}, {3, 3, max_k}})
    EXPECT_NO_THROW(name.check()) << name.text();
  for (const HbvmName& name : {HbvmName{max_k + 1, 1},
                               {max_s + 1, max_s + 1},
                               {0, max_s + 1},
                               {2, 3},
                               {2, 0},
                               {0, 0},
                               {-3, 1},
                               {3, 3, 2},
                               {3, 3, max_k + 1},
                               {3, 3, -3}})
    EXPECT_THROW(name.check(), InputError) << name.text();
}

TEST(ExactNodes, AreHalfOfDegreeTimesS) {
  EXPECT_EQ(exact_nodes(2, 3), 3);
  EXPECT_EQ(exact_nodes(0, 3), 3);
  EXPECT_EQ(exact_nodes(4, 3), 6);
  EXPECT_EQ(exact_nodes(3, 3), 5);
  EXPECT_EQ(exact_nodes(2 * max_k, 1), max_k);
}

TEST(ExactNodes, MoreThanThereMayBeAreRefused) {
  for (const int degree : {2 * max_k + 1, 2'000'000'000})
    expect_words(message_of([&] { exact_nodes(degree, 1); }), {"degree " + std::to_string(degree)});
}

class RefusedMethod : public ::testing::TestWithParam<const char*> {};

TEST_P(RefusedMethod, IsAnInputErrorThatQuotesIt) {
  expect_words(message_of([&] { HbvmName::parse(GetParam()); }), {GetParam()});
}

INSTANTIATE_TEST_SUITE_P(Forms, RefusedMethod,
                         ::testing::Values("", "hbvm", "hbvm:", "hbvm:5", "hbvm:5,", "hbvm:,3", "hbvm:5,3,1",
                                           "hbvm:5,3,", "hbvm:5,3,0", "hbvm:5,3,3,3", "hbvm:5,3,-3", "hbvm:5,3,auto",
                                           "hbvm:5,3 ", " hbvm:5,3", "hbvm: 5,3", "hbvm:5, 3", "hbvm:+5,3",
                                           "hbvm:5.0,3", "hbvm:5;3", "HBVM:5,3", "hbvm(5,3)", "gauss:3", "hbvm:five,3",
                                           "hbvm:auto", "hbvm:auto,", "hbvm:auto5,3", "hbvm:Auto,3",
                                           "hbvm:99999999999,3", "hbvm:5,99999999999"));
INSTANTIATE_TEST_SUITE_P(Limits, RefusedMethod,
                         ::testing::Values("hbvm:2,3", "hbvm:0,0", "hbvm:5,0", "hbvm:0,3", "hbvm:-5,3", "hbvm:5,-3",
                                           "hbvm:1001,3", "hbvm:201,201", "hbvm:auto,0", "hbvm:auto,201",
                                           "hbvm:auto,-1"));

}  // namespace
}  // namespace hbvm::core
