#include "scalar/precision.hpp"

#include <gtest/gtest.h>

#include "hbvm/error.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

TEST(Precision, ReadsDouble) {
  const Precision precision = Precision::parse("double");
  EXPECT_EQ(precision.kind(), Precision::Kind::binary64);
  EXPECT_EQ(precision.digits(), 15u);
}

TEST(Precision, ReadsQuad) {
  const Precision precision = Precision::parse("quad");
  EXPECT_EQ(precision.kind(), Precision::Kind::binary128);
  EXPECT_EQ(precision.digits(), 33u);
  EXPECT_EQ(precision.name(), precision_of_34_digits());
}

TEST(Precision, ReadsMpfrWithinItsLimits) {
  for (const unsigned digits : {20u, 21u, 50u, 9'999u, 10'000u}) {
    const Precision precision = Precision::parse("mpfr:" + std::to_string(digits));
    EXPECT_EQ(precision.kind(), Precision::Kind::mpfr);
    EXPECT_EQ(precision.digits(), digits);
    EXPECT_EQ(Precision::parse(std::to_string(digits)), precision) << "the digits alone";
  }
}

TEST(Precision, NameReadsBack) {
  for (const char* name : {"double", "quad", "mpfr:20", "mpfr:50", "mpfr:10000"}) {
    const Precision precision = Precision::parse(name);
    EXPECT_EQ(precision.name(), name);
    EXPECT_EQ(Precision::parse(precision.name()), precision);
  }
}

TEST(Precision, TellsPrecisionsApart) {
  EXPECT_NE(Precision::parse("mpfr:50"), Precision::parse("mpfr:51"));
  EXPECT_NE(Precision::parse("quad"), Precision::parse("mpfr:33"));
  EXPECT_NE(Precision::parse("double"), Precision::parse("quad"));
}

class RefusedPrecision : public ::testing::TestWithParam<const char*> {};

TEST_P(RefusedPrecision, IsAnInputErrorThatQuotesIt) {
  expect_words(message_of([&] { Precision::parse(GetParam()); }), {"'" + std::string(GetParam()) + "'"});
}

INSTANTIATE_TEST_SUITE_P(Forms, RefusedPrecision,
                         ::testing::Values("", " ", "Double", "double ", " quad", "QUAD", "float", "mpfr",
                                           "mpfr:", "mpfr50", "Mpfr:50", "mpfr: 50", "mpfr:50 ", "mpfr:+50", "mpfr:-50",
                                           "mpfr:50.0", "mpfr:1e3", "mpfr:0x40", "mpfr:fifty", "mpfr:50,60", "50.0"));
INSTANTIATE_TEST_SUITE_P(Limits, RefusedPrecision,
                         ::testing::Values("mpfr:0", "mpfr:1", "mpfr:19", "19", "0", "10001", "mpfr:10001",
                                           "mpfr:4294967316", "mpfr:18446744073709551666"));

}  // namespace
}  // namespace hbvm::core
