#include "audit/claim.hpp"

#include <gtest/gtest.h>

#include "step/hbvm_method.hpp"
#include "step/tableau_method.hpp"

namespace hbvm::core {
namespace {

TEST(Claims, NameTheirMethod) {
  Claim claim;
  claim.method = hbvm_of({12, 3});
  EXPECT_EQ(claim.method_text(), "HBVM(12,3)");
  claim.method = std::make_shared<const TableauMethod>(Tableau{"Gauss, two stages", {}, {}, {}, {}}, "");
  EXPECT_EQ(claim.method_text(), "Gauss, two stages");
}

TEST(Claims, AreReadableWithThePrintedPaper) {
  EXPECT_EQ(readable("ord2s"), "Theorem 5 (ord2s)");
  EXPECT_EQ(readable("ord2sk, one step"), "Theorem 9 (ord2sk), one step");
  EXPECT_EQ(readable("superconvergence"), "superconvergence");
  EXPECT_EQ(readable("ord2s of mine"), "ord2s of mine");
}

}  // namespace
}  // namespace hbvm::core
