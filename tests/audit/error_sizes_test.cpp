#include "audit/error_sizes.hpp"

#include <gtest/gtest.h>

namespace hbvm::core {
namespace {

TEST(AuditSizes, AreTheGreatestOfEach) {
  ErrorSizes sizes;
  raise(sizes, Quantity::q, -10, -50);
  raise(sizes, Quantity::q, -12, -40);
  raise(sizes, Quantity::p, -30, -60);
  raise(sizes, Quantity::q, -8, -45);
  EXPECT_EQ(sizes.size(), 2u);
  EXPECT_EQ(sizes.at(Quantity::q).error, -8);
  EXPECT_EQ(sizes.at(Quantity::q).floor, -40);
  EXPECT_EQ(sizes.at(Quantity::p).error, -30);
  EXPECT_EQ(sizes.at(Quantity::p).floor, -60);
}

TEST(AuditMargins, AreFourBitsAboveTheReferencesErrors) {
  Margins margins;
  EXPECT_TRUE(margins.set(Margins::none));
  margins.raise(Margins({-40, -50, -60}));
  margins.raise(Margins({-45, -44, -61}));
  EXPECT_EQ(margins.q, -36);
  EXPECT_EQ(margins.p, -40);
  EXPECT_EQ(margins.lambda, -56);
  for (const double floor : {-36, -40, -56}) EXPECT_TRUE(margins.set(floor));
  EXPECT_FALSE(margins.set(-41)) << "round-off";
}

}  // namespace
}  // namespace hbvm::core
