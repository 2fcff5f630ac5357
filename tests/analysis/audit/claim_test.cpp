#include "hbvm/analysis/audit/claim.hpp"

#include <gtest/gtest.h>

#include "hbvm/step/hbvm_method.hpp"
#include "hbvm/step/tableau_method.hpp"

namespace hbvm {
namespace {

TEST(Claims, NameTheirMethod) {
  Claim claim;
  claim.method = hbvm_of({12, 3});
  EXPECT_EQ(claim.method_text(), "HBVM(12,3)");
  claim.method = std::make_shared<const TableauMethod>(Tableau{"Gauss, two stages", {}, {}, {}, {}}, "");
  EXPECT_EQ(claim.method_text(), "Gauss, two stages");
}

}  // namespace
}  // namespace hbvm
