#include "solver/body_scale.hpp"

#include "linear/arrays.hpp"
#include "printing.hpp"
#include "scene/assemble.hpp"

namespace hbvm::core {
namespace {

/// Two bodies in a plane, the second four times as large. Its first coordinate is small.
template <class S>
class BodyScaleTest : public InDigits<50> {
 protected:
  void show(std::initializer_list<S> terms) {
    Matrix<S> row(1, 4);
    std::copy(terms.begin(), terms.end(), row.data());
    rule.show_change(row);
    rule.show_terms(row);
    rule.judge();
  }
  S measured(std::initializer_list<S> change) {
    Matrix<S> row(1, 4);
    std::copy(change.begin(), change.end(), row.data());
    S size = 0;
    scale.measure(row, rule, size);
    return size;
  }
  bool leaves_little(std::initializer_list<S> residual) {
    Matrix<S> row(1, 4);
    std::copy(residual.begin(), residual.end(), row.data());
    return scale.leaves_little(row, rule);
  }

  Assembled<S> scene = assemble<S>(load_scene("double_pendulum"));
  const Vector<S> nothing = Vector<S>::Zero(4);
  StoppingRule<S> rule{4, 100};
  BodyScale<S> scale{scene.problem};
  void SetUp() override {
    ASSERT_EQ(scene.problem.mass.blocks().size(), 2u);
    rule.start(nothing, nothing);
    show({S(1), S(2), S(1) / 4, S(8)});
    scale.keep(rule);
  }
};
TYPED_TEST_SUITE(BodyScaleTest, AllScalars, ScalarNames);

TYPED_TEST(BodyScaleTest, IsTheGreatestOfTheBodysCoordinates) {
  EXPECT_EQ(this->scale.of_coordinates(), (Vector<TypeParam>{{2, 2, 8, 8}}));
}

TYPED_TEST(BodyScaleTest, MeasuresChangesBodyByBody) {
  using S = TypeParam;
  EXPECT_EQ(this->measured({S(0), S(0), S(-4), S(1)}), S(1) / 2);
  EXPECT_EQ(this->measured({S(1), S(0), S(-2), S(0)}), S(1) / 2);
  EXPECT_EQ(this->measured({S(0), S(0), S(0), S(0)}), S(0));
}

/// Scales of now do not change what is measured, but decide on residuals, and on bodies that had none.
TYPED_TEST(BodyScaleTest, IsKeptUntilTheNext) {
  using S = TypeParam;
  this->show({S(16), S(16), S(16), S(16)});
  EXPECT_EQ(this->measured({S(1), S(0), S(0), S(0)}), S(1) / 2);
  EXPECT_TRUE(this->leaves_little({S(1), S(-1), S(0), S(1)}));
  EXPECT_FALSE(this->leaves_little({S(1), S(0), S(0), S(-2)}));
  EXPECT_FALSE(this->leaves_little({S(-2), S(0), S(0), S(0)}));

  this->rule.start(this->nothing, this->nothing);
  this->show({S(0), S(0), S(1), S(1)});
  this->scale.keep(this->rule);
  this->show({S(1), S(4), S(1), S(1)});
  EXPECT_EQ(this->measured({S(1), S(1), S(0), S(0)}), S(1));
}

}  // namespace
}  // namespace hbvm::core
