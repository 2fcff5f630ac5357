#include "problem/formula/symmetry.hpp"

#include "printing.hpp"
#include "problem/momenta.hpp"
#include "scalar/literal.hpp"

namespace hbvm::core {
namespace {

using Names = std::vector<std::string>;

const Constants symmetry_constants{{"k", Expression::parse("3/7")}};

/// Two bodies in space; the names of what U keeps.
template <class S>
class FormulaSymmetry : public InDigits<50> {
 protected:
  /// U of both positions, x1 ... z2.
  std::vector<std::string> kept(const std::string& text) {
    using Is = FormulaVariable::Is;
    const Expression read = Expression::parse(text, Expression::Syntax::formula);
    FormulaInput<S> input{read, symmetry_constants, 3, 2};
    for (std::size_t i = 0; i < 6; ++i)
      input.variables[std::string(1, "xyz"[i % 3]) + (i < 3 ? "1" : "2")] = {Is::input, i};
    input.variables["r"] = {Is::distance, 0};
    input.instances = {{{{{{0, S(1)}}, {}}, {{{3, S(1)}}, {}}}, {}}};
    Problem<S> problem;
    problem.dimension = 3;
    problem.mass.add_scalar(3, S(1));
    problem.mass.add_scalar(3, S(2));
    problem.blocks = {{0, true}, {3, true}};
    problem.potential.dimension = 3;
    problem.potential.m = 6;
    Vector<S> q(6);
    q << S(1), S(2), S(3), S(-1), S(1), S(2);
    EffectTerm<S> term = make_term(input);
    term.symmetry = formula_symmetry(input, problem.blocks, q);
    problem.potential.terms.push_back(term);
    std::vector<std::string> names;
    for (const auto& component : conserved_momenta(problem)) names.push_back(component.name());
    return names;
  }
};
TYPED_TEST_SUITE(FormulaSymmetry, AllScalars, ScalarNames);

TYPED_TEST(FormulaSymmetry, IsFoundFromTheFormula) {
  const Names all{"P_x", "P_y", "P_z", "L_x", "L_y", "L_z"}, turns{"L_x", "L_y", "L_z"};
  EXPECT_EQ(this->kept("1/r"), all);
  EXPECT_EQ(this->kept("2"), all);
  EXPECT_EQ(this->kept("exp(-((x1 - x2)^2 + (y1 - y2)^2 + (z1 - z2)^2)/k)"), all);
  EXPECT_EQ(this->kept("x1^2 + y1^2 + z1^2 + atan(r)"), turns);
  EXPECT_EQ(this->kept("x1*x2 + y1*y2 + z1*z2"), turns);
  EXPECT_EQ(this->kept("sin(z1 - z2)"), (Names{"P_x", "P_y", "P_z", "L_z"}));
  EXPECT_EQ(this->kept("z1*z2"), (Names{"P_x", "P_y", "L_z"}));
  EXPECT_EQ(this->kept("x1*y2 - x2*y1"), (Names{"P_z", "L_z"}));
  EXPECT_EQ(this->kept("(x1 - 1)^2 + (y1 - 2)^2 + cos(z1)"), (Names{"L_z + 2 P_x - P_y"}));
  EXPECT_EQ(this->kept("x1*y1^2*z1^3"), (Names{}));
}

/// Only the digits of the scene limit what is told apart, not how weak it is.
TYPED_TEST(FormulaSymmetry, IsBrokenByWhatIsWeak) {
  EXPECT_EQ(this->kept("1/r + 1e-200*x1"), (Names{"P_y", "P_z", "L_x"}));
  EXPECT_EQ(this->kept("(x1^2 + y1^2)/3 + (z1*2)^2/12"), (Names{"L_x", "L_y", "L_z"})) << "equal, if not as rounded";
}

/// A narrow bump or a steep wall that is far from the start, and in no number of digits seen from there.
TYPED_TEST(FormulaSymmetry, IsBrokenByWhatIsFarAway) {
  EXPECT_EQ(this->kept("r^2 + exp(-((x1 - x2 - 5)/1e-3)^2)"), (Names{"P_x", "P_y", "P_z", "L_x"}));
  EXPECT_EQ(this->kept("exp(-((x1 - 5)/1e-8)^2)"), (Names{"P_y", "P_z", "L_x"})) << "too small for a number";
  EXPECT_EQ(this->kept("exp(-((x1 + 7)*1e7)^2)"), (Names{"P_y", "P_z", "L_x"})) << "10^15 digits below 1";
  EXPECT_EQ(this->kept("exp(-((x1 + 7)*1e12)^2)"), (Names{"P_y", "P_z", "L_x"})) << "beyond all exponents";
  EXPECT_EQ(this->kept("1/r - exp(-((x1 + 7)*1e7)^2)"), (Names{"P_y", "P_z", "L_x"})) << "beside another";
  EXPECT_EQ(this->kept("k*(r^2 - exp(-((x1 + 7)*1e7)^2))"), (Names{"P_y", "P_z", "L_x"})) << "within a product";
  EXPECT_EQ(this->kept("r^2 + tanh((z1 - 1/2)/1e-5)"), (Names{"P_x", "P_y", "L_z"}));
  EXPECT_EQ(this->kept("r^2 + 1/cosh((z1 - 1/2)/1e-4) + exp(-(y1/1e-9))"), (Names{"P_x"}));
}

/// And kept by one that is symmetric itself.
TYPED_TEST(FormulaSymmetry, IsKeptByWhatIsFarAway) {
  const Names all{"P_x", "P_y", "P_z", "L_x", "L_y", "L_z"};
  EXPECT_EQ(this->kept("exp(-(r/1e-8)^2) + exp(-r/1e-5)/r"), all);
  EXPECT_EQ(this->kept("1/r + exp(-1e9*r)/r"), all);
  EXPECT_EQ(this->kept("k/2"), all);
  EXPECT_EQ(this->kept("exp(-(x1^2 + y1^2)*1e14)*exp(-z1^2*1e14)"), (Names{"L_x", "L_y", "L_z"}));
  EXPECT_EQ(this->kept("z1 + exp(-(x1^2 + y1^2)/1e-12)"), (Names{"L_z"}));
}

/// About an axis whose direction has no short digits.
TYPED_TEST(FormulaSymmetry, HasAnyAxis) {
  const auto kept = this->kept("sqrt(x1^2 + y1^2 + z1^2) + (sqrt(2)*x1 + sqrt(3)*y1)^3");
  ASSERT_EQ(kept.size(), 1u);
  EXPECT_EQ(kept.front(), "L_x + 1.22474 L_y");
}

/// Where U has no value all around, the points are nearer.
TYPED_TEST(FormulaSymmetry, IsFoundInANarrowDomain) {
  EXPECT_EQ(this->kept("sqrt(14.01 - x1^2 - y1^2 - z1^2)"), (Names{"L_x", "L_y", "L_z"}));
}

}  // namespace
}  // namespace hbvm::core
