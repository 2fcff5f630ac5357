#include "method/symmetry_defect.hpp"

#include "method/tableaux.hpp"

namespace hbvm::core {
namespace {

template <class S>
using SymmetryDefectTest = TableauTest<S>;
TYPED_TEST_SUITE(SymmetryDefectTest, AllScalars, ScalarNames);

TYPED_TEST(SymmetryDefectTest, RadauIsNeitherSymmetricNorSymplectic) {
  const auto method = make_runge_kutta<TypeParam>(radau_iia());
  this->expect_nonzero(symmetry_defect(method), "symmetry");
  this->expect_nonzero(symplecticity_defect(method), "symplecticity");
  this->expect_zero(condition_B(method, 3), "B", 2);
  this->expect_zero(condition_C(method, 2), "C", 2);
  this->expect_zero(condition_D(method, 1), "D", 2);
  this->expect_nonzero(condition_B(method, 4), "B(4)");
  this->expect_nonzero(condition_C(method, 3), "C(3)");
  this->expect_nonzero(condition_D(method, 2), "D(2)");
  EXPECT_EQ(condition_B(method, 0), 0);
}

TYPED_TEST(SymmetryDefectTest, TrapezoidalRuleIsSymmetricButNotSymplectic) {
  const auto method = make_runge_kutta<TypeParam>(tableau({{"0", "0"}, {"1/2", "1/2"}}, {"1/2", "1/2"}, {"0", "1"}));
  EXPECT_EQ(symmetry_defect(method), 0);
  EXPECT_EQ(symplecticity_defect(method), literal<TypeParam>("1/4"));
}

TYPED_TEST(SymmetryDefectTest, ThreeStagesOfLobattoAreSymmetric) {
  const auto method = make_runge_kutta<TypeParam>(tableau(
      {{"0", "0", "0"}, {"5/24", "1/3", "-1/24"}, {"1/6", "2/3", "1/6"}}, {"1/6", "2/3", "1/6"}, {"0", "1/2", "1"}));
  this->expect_zero(symmetry_defect(method), "symmetry", 3);
}

}  // namespace
}  // namespace hbvm::core
