#include "report/axis_range.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace hbvm::core {
namespace {

std::vector<std::string> texts(const Tics& tics) {
  std::vector<std::string> result;
  for (const Tic& tic : tics.tics)
    if (!tic.text.empty()) result.push_back(tic.text);
  return result;
}
using Texts = std::vector<std::string>;

TEST(AxisRange, EndsWhereTheDataEnd) {
  const double infinity = std::numeric_limits<double>::infinity();
  const AxisRange range = range_of({3, -infinity, 1, NAN, 7, infinity});
  EXPECT_EQ(range.from, 1);
  EXPECT_EQ(range.to, 7);
  EXPECT_EQ(widened(range, 0.5).from, -2);
  EXPECT_EQ(widened(range, 0.5).to, 10);
}

TEST(AxisRange, HasALengthAlways) {
  for (const std::vector<double>& values :
       {std::vector<double>{}, {0.0}, {5.0, 5.0}, {-3e-200}, {1e200, 1e200 * (1 + 1e-15)}, {NAN}}) {
    const AxisRange range = range_of(values);
    EXPECT_GT(range.length(), 0);
    for (const double value : values) EXPECT_TRUE(std::isnan(value) || (range.from <= value && value <= range.to));
  }
}

/// Wherever the only value of a logarithmic axis lies.
TEST(AxisRange, OfPowersHasRoomForATicWithANumber) {
  for (const AxisScale scale : {AxisScale::decimal, AxisScale::falling, AxisScale::binary})
    for (int hundredth = -350; hundredth <= 350; ++hundredth) {
      const double at = hundredth / 100.0;
      const AxisRange range = range_of({at, at + 0.01}, scale);
      EXPECT_LE(range.from, at);
      EXPECT_GE(range.to, at + 0.01);
      EXPECT_FALSE(texts(tics_of(range, scale, 6)).empty()) << at;
    }
  EXPECT_EQ(range_of({1, 4}, AxisScale::decimal).from, 1);
  EXPECT_EQ(range_of({1, 4}, AxisScale::decimal).to, 4);
}

TEST(Tics, AreRoundNumbers) {
  EXPECT_EQ(texts(tics_of({0, 20}, AxisScale::linear, 6)), (Texts{"0", "5", "10", "15", "20"}));
  EXPECT_EQ(texts(tics_of({-1.03, 1.05}, AxisScale::linear, 6)), (Texts{"-1.0", "-0.5", "0.0", "0.5", "1.0"}));
  EXPECT_EQ(texts(tics_of({0.2, 0.29}, AxisScale::linear, 6)), (Texts{"0.20", "0.22", "0.24", "0.26", "0.28"}));
}

TEST(Tics, HaveAPowerOfTenInCommon) {
  const Tics tics = tics_of({-3e-9, 2.9e-9}, AxisScale::linear, 6);
  EXPECT_EQ(tics.factor, "10^{-9}");
  EXPECT_EQ(texts(tics), (Texts{"-3", "-2", "-1", "0", "1", "2"}));
  EXPECT_NEAR(tics.tics.front().at, -3e-9, 1e-20);
  EXPECT_EQ(tics_of({0, 2e6}, AxisScale::linear, 6).factor, "10^{6}");
  EXPECT_EQ(tics_of({0, 2e4}, AxisScale::linear, 6).factor, "");
}

TEST(Tics, OfErrorsThatFallToTheRightAreNegativePowers) {
  EXPECT_EQ(texts(tics_of({2, 14}, AxisScale::falling, 6)), (Texts{"10^{-3}", "10^{-6}", "10^{-9}", "10^{-12}"}));
}

TEST(Tics, OfPowersStandAtPowers) {
  EXPECT_EQ(texts(tics_of({-16.3, -8}, AxisScale::decimal, 6)),
            (Texts{"10^{-16}", "10^{-14}", "10^{-12}", "10^{-10}", "10^{-8}"}));
  EXPECT_EQ(texts(tics_of({-12, -2}, AxisScale::binary, 6)),
            (Texts{"2^{-12}", "2^{-10}", "2^{-8}", "2^{-6}", "2^{-4}", "2^{-2}"}));
  // Between powers there are small ones, at the logarithms of 2 to 9.
  EXPECT_EQ(texts(tics_of({std::log10(20), 3}, AxisScale::decimal, 6)),
            (Texts{"100", "1000", "20", "50", "200", "500"}));
  const Tics tics = tics_of({-1, 1}, AxisScale::decimal, 6);
  EXPECT_EQ(texts(tics), (Texts{"10^{-1}", "10^{0}", "10^{1}"}));
  EXPECT_EQ(tics.tics.size(), 3u + 2 * 8);
}

TEST(AxisRange, EndsAtRoundOff) {
  EXPECT_EQ(ended_at_round_off({-40, -2}, -16).from, -17);
  EXPECT_EQ(ended_at_round_off({-40, -2}, -16).to, -2);
  EXPECT_EQ(ended_at_round_off({-40, -30}, -16).to, -15);
}

TEST(Tics, OfLessThanTwoPowersAreNumbersBetween) {
  const Tics tics = tics_of({-15.8, -15.2}, AxisScale::decimal, 6);
  EXPECT_EQ(texts(tics), (Texts{"2·10^{-16}", "5·10^{-16}"}));
  for (const Tic& tic : tics.tics) {
    EXPECT_GE(tic.at, -15.8);
    EXPECT_LE(tic.at, -15.2);
  }
}

TEST(Tics, AreNoMoreThanHaveRoom) {
  for (const double from : {-1e6, -350.0, -16.7, -3.14, 0.0, 2.5})
    for (const double length : {0.3, 1.0, 2.0, 7.7, 30.0, 99.0, 1234.5})
      for (const AxisScale scale : {AxisScale::linear, AxisScale::binary, AxisScale::decimal}) {
        if (scale != AxisScale::linear && std::abs(from) > 1000) continue;
        const std::size_t count = texts(tics_of({from, from + length}, scale, 6)).size();
        EXPECT_LE(count, 6u) << from << " " << length;
        EXPECT_TRUE(count >= 2 || (length < 2 && scale != AxisScale::linear)) << from << " " << length;
      }
}

}  // namespace
}  // namespace hbvm::core
