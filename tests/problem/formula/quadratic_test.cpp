#include "problem/formula/quadratic.hpp"

#include "hbvm/error.hpp"
#include "printing.hpp"
#include "problem/constraint.hpp"
#include "scalar/literal.hpp"

namespace hbvm::core {
namespace {

const Constants quadratic_constants{{"L", Expression::parse("1/10")}};

/// Of two bodies in the plane, at 0 and 4 of q; x1, y1, x2, y2.
template <class S>
class QuadraticForms : public InDigits<50> {
 protected:
  std::optional<ConstraintForms<S>> form(const std::string& text) {
    using Is = FormulaVariable::Is;
    const Expression read = Expression::parse(text, Expression::Syntax::formula);
    return quadratic_form(FormulaInput<S>{
        read,
        quadratic_constants,
        2,
        2,
        {{"x1", {Is::input, 0}}, {"y1", {Is::input, 1}}, {"x2", {Is::input, 2}}, {"y2", {Is::input, 3}}},
        0,
        {{{{{{0, S(1)}}, {}}, second}, {}}}});
  }
  Displacement<S> second{{{4, S(1)}}, {}};

  static Vector<S> somewhere() {
    Vector<S> q(6);
    for (Index i = 0; i < 6; ++i) q[i] = S(static_cast<int>(i * i) - 7) / 3;
    return q;
  }
  static S value_at(const ConstraintForms<S>& form, const Vector<S>& q) {
    return value(Constraint<S>{"", form}, 2, q).g;
  }
};
TYPED_TEST_SUITE(QuadraticForms, AllScalars, ScalarNames);

TYPED_TEST(QuadraticForms, AreRodsWhereTheyAreALength) {
  using S = TypeParam;
  const auto form = this->form("(x1 - x2)^2 + (y2 - y1)*(y2 - y1) - L^2");
  ASSERT_TRUE(form);
  const auto* const rod = std::get_if<Rod<S>>(&*form);
  ASSERT_TRUE(rod);
  EXPECT_EQ(rod->square, literal<S>("1/100"));
  EXPECT_EQ(rod->x.shift.size(), 0);
  ASSERT_EQ(rod->x.blocks.size(), 2u);
  EXPECT_EQ(rod->x.blocks[0].weight, 1);
  EXPECT_EQ(rod->x.blocks[1].weight, -1);
  EXPECT_EQ(rod->x.blocks[1].offset, 4);
}

/// A circle about a point, and about a fixed one that is named.
TYPED_TEST(QuadraticForms, AreRodsAboutAPoint) {
  using S = TypeParam;
  const auto circle = this->form("x1^2 + y1^2 - 2*x1/3 + 4*y1 + 4");
  ASSERT_TRUE(circle);
  const auto* const rod = std::get_if<Rod<S>>(&*circle);
  ASSERT_TRUE(rod);
  EXPECT_EQ(rod->square, S(1) / 9);
  ASSERT_EQ(rod->x.shift.size(), 2);
  EXPECT_EQ(rod->x.shift[0], S(-1) / 3);
  EXPECT_EQ(rod->x.shift[1], 2);
  this->second = {{}, Vector<S>(Vector<S>::Constant(2, S(3)))};
  const auto pin = this->form("(x2 - x1)^2 + (y2 - y1)^2 - 1");
  ASSERT_TRUE(pin);
  ASSERT_TRUE(std::holds_alternative<Rod<S>>(*pin));
  EXPECT_EQ(std::get<Rod<S>>(*pin).x.shift[0], -3);
  EXPECT_EQ(this->value_at(*pin, Vector<S>(Vector<S>::Constant(6, S(2)))), 1);
}

TYPED_TEST(QuadraticForms, ArePlanesWhereTheyAreLinear) {
  using S = TypeParam;
  this->second = {{}, Vector<S>(Vector<S>::Constant(2, S(3)))};
  const auto form = this->form("2*x1 - (y1 + 1)/4 + x2");
  ASSERT_TRUE(form);
  ASSERT_TRUE(std::holds_alternative<Plane<S>>(*form));
  EXPECT_EQ(std::get<Plane<S>>(*form).normal[1], S(-1) / 4);
  EXPECT_EQ(std::get<Plane<S>>(*form).offset, S(-11) / 4);
}

TYPED_TEST(QuadraticForms, AreQuadricsElse) {
  using S = TypeParam;
  const auto q = this->somewhere();
  const S x1 = q[0], y1 = q[1], x2 = q[4], y2 = q[5];
  const std::pair<const char*, S> cases[] = {
      {"x1*y2 - 3*x2 + 1", x1 * y2 - 3 * x2 + 1},
      {"(x1 - x2)^2 + 4*(y1 - y2)^2 - 1", (x1 - x2) * (x1 - x2) + 4 * (y1 - y2) * (y1 - y2) - 1},
      {"x1^2 + y1^2 + 1", x1 * x1 + y1 * y1 + 1},
      {"2*x1^2 + 2*y1^2 - 1", 2 * (x1 * x1 + y1 * y1) - 1},
      {"x1^2 + y1^2 - x2 - 1", x1 * x1 + y1 * y1 - x2 - 1},
      {"x1 + y2 - 2", x1 + y2 - 2}};
  for (const auto& [text, expected] : cases) {
    const auto form = this->form(text);
    ASSERT_TRUE(form) << text;
    EXPECT_TRUE(std::holds_alternative<Quadric<S>>(*form)) << text;
    EXPECT_LE(magnitude(S(this->value_at(*form, q) - expected)), 64 * epsilon<S>() * (1 + magnitude(expected))) << text;
  }
}

/// Large terms that cancel leave the digits of what remains.
TYPED_TEST(QuadraticForms, HaveCoefficientsRightToTheLastBit) {
  using S = TypeParam;
  const auto form = this->form("(x1 + 10^20)^2 - (x1 - 10^20)^2 + y1/3 - 4*10^20*x1 + x1*y1 - 1/7");
  ASSERT_TRUE(form);
  ASSERT_TRUE(std::holds_alternative<Quadric<S>>(*form));
  const auto& quadric = std::get<Quadric<S>>(*form);
  EXPECT_EQ(quadric.b[0], 0);
  EXPECT_EQ(quadric.b[1], S(1) / 3);
  EXPECT_EQ(quadric.A(0, 1), S(1) / 2);
  EXPECT_EQ(quadric.A(0, 0), 0);
  EXPECT_EQ(quadric.c, S(-1) / 7);
}

TYPED_TEST(QuadraticForms, OfPointsOfARigidBodyAreThoseOfItsCoordinates) {
  using S = TypeParam;
  this->second = {{{2, S(1)}, {4, S(1) / 2}}, Vector<S>(Vector<S>::Constant(2, S(1)))};
  const auto q = this->somewhere();
  const S x2 = q[2] + q[4] / 2 + 1, y2 = q[3] + q[5] / 2 + 1;
  const auto form = this->form("x1*x2 + 3*y2^2 - y2");
  ASSERT_TRUE(form);
  EXPECT_LE(magnitude(S(this->value_at(*form, q) - (q[0] * x2 + 3 * y2 * y2 - y2))), 256 * epsilon<S>());
  const auto rod = this->form("(x1 - x2)^2 + (y1 - y2)^2 - 3");
  ASSERT_TRUE(rod && std::holds_alternative<Rod<S>>(*rod));
  const S g = (q[0] - x2) * (q[0] - x2) + (q[1] - y2) * (q[1] - y2) - 3;
  EXPECT_LE(magnitude(S(this->value_at(*rod, q) - g)), 256 * epsilon<S>());
}

TYPED_TEST(QuadraticForms, AreNoneOfOtherFormulas) {
  EXPECT_FALSE(this->form("x1^3 + y1^2 - 1"));
  EXPECT_FALSE(this->form("sqrt(x1^2 + y1^2) - 1"));
  EXPECT_FALSE(this->form("x1*y1*x2"));
}

}  // namespace
}  // namespace hbvm::core
