// Scenes with formulas: what they may say, and that they are what is built in.

#include <cstdlib>
#include <random>

#include "problem/curvature.hpp"
#include "problem/discrete_force.hpp"
#include "problem/effect/trace.hpp"
#include "problem/energy_terms.hpp"
#include "scene/assembled.hpp"
#include "scene/formula_scene.hpp"
#include "scene/joined_bodies.hpp"

namespace hbvm::core {
namespace {

template <class S>
class FormulaScene : public InDigits<50> {
 protected:
  /// All that the problem of a scene says, at a state and one step from it.
  static std::vector<S> all(const std::string& text) {
    const Assembled<S> scene = assembled<S>(text);
    const Problem<S>& problem = scene.problem;
    const Vector<S> q = away_from(scene.q0), p = away_from(scene.p0);
    std::vector<S> result;
    const auto add = [&](const auto& values) {
      result.insert(result.end(), values.data(), values.data() + values.size());
    };
    StateEvaluator<S> point(problem);
    result.push_back(point.energy(q, p));
    result.push_back(point.energy_size(q, p));
    add(point.constraints(q));
    add(point.hidden_constraints(q, p));
    add(point.multiplier(q, p));
    add(point.forces(q, p).applied);
    EnergyTerms<S> energy(problem);
    energy.evaluate(q, p);
    result.push_back(energy.H());
    DiscreteForce<S> discrete(problem.potential);
    Matrix<S> force(1, problem.m());
    discrete.evaluate(scene.q0, q, force);
    add(force);
    Curvature<S> curvature(problem, 1, 1);
    const Matrix<S>& second = curvature.potential(lanes(q));
    Matrix<S> full = Matrix<S>::Zero(problem.m(), problem.m());
    for (std::size_t i = 0; i < curvature.pairs().size(); ++i)
      full(curvature.pairs()[i].row, curvature.pairs()[i].column) = second(0, static_cast<Index>(i));
    add(full);
    return result;
  }
  /// That two scenes say the same but for rounding.
  static void expect_near(const std::string& text, const std::string& other) {
    SCOPED_TRACE(text);
    const auto found = all(text), expected = all(other);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i)
      EXPECT_LE(magnitude(S(found[i] - expected[i])), 256 * epsilon<S>() * (1 + magnitude(expected[i]))) << i;
  }
};
TYPED_TEST_SUITE(FormulaScene, AllScalars, ScalarNames);

TYPED_TEST(FormulaScene, HasTheDigitsOfTheSameBuiltIn) {
  EXPECT_EQ(this->all(pendulum_by_formulas), this->all(pendulum_as_built_in));
  const auto formulas = assembled<TypeParam>(pendulum_by_formulas);
  ASSERT_EQ(formulas.problem.nu(), 2);
  EXPECT_EQ(formulas.problem.constraints[1].name, "formula of 'a', 'b'");
  for (const auto& constraint : formulas.problem.constraints)
    EXPECT_TRUE(std::holds_alternative<Rod<TypeParam>>(constraint.form));
}

/// The same U of two positions instead of their difference, of a group by number and by name.
TYPED_TEST(FormulaScene, MaySayTheSameInOtherNames) {
  const std::string pair = "between = [[\"a\", \"b\"], [\"pivot\", \"b\"]]\nU = \"-k*Q1*Q2/r\"";
  for (const char* const other :
       {"between = [[\"a\", \"b\"], [\"pivot\", \"b\"]]\nU = \"-k*Q1*Q2/sqrt((x1 - x2)^2 + (y1 - y2)^2)\"",
        "between = [[\"a\", \"b\"], [\"pivot\", \"b\"]]\nU = \"-k*Q1*Q2/sqrt(x^2 + y^2) + 0*x1\"",
        "of = [\"a\", \"pivot\", \"b\"]\nU = \"-k*a.Q*b.Q/sqrt((a.x - b.x)^2 + (a.y - y3)^2) - "
        "k*Q2*Q3/sqrt((pivot.x - b.x)^2 + (y2 - b.y)^2)\""})
    this->expect_near(changed(pendulum_by_formulas, pair, other), pendulum_as_built_in);
}

TYPED_TEST(FormulaScene, KeepsTheMomentaOfItsSymmetries) {
  const auto names = [](const std::string& text) { return conserved(assembled<TypeParam>(text).problem); };
  const std::string without_gravity =
      changed(pendulum_by_formulas, "[[effect]]\nkind = \"formula\"\nU = \"-9.81*m*y\"\n", "");
  EXPECT_EQ(names(pendulum_by_formulas), "");
  EXPECT_EQ(names(without_gravity), "L_z");
  EXPECT_EQ(names(changed(without_gravity, "-2/2*r^2", "-2/2*r^2 - x^3")), "");
  // A quadric of two bodies.
  const std::string first = "[[constraint]]\nkind = \"formula\"\non = \"a\"\ng = \"x^2 + y^2 - 1\"\n";
  const std::string scene = changed(without_gravity, first,
                                    "[[constraint]]\nkind = \"formula\"\nbetween = [\"a\", \"b\"]\n"
                                    "g = \"2*(x1*x2 + y1*y2) - 2*1.4\"\n");
  const std::string at_rest =
      changed(changed(scene, "[\"2/5\", \"3/10\"]", "[0, 0]"), "[\"7/10\", \"3/10\"]", "[0, 0]");
  EXPECT_EQ(names(at_rest), "L_z");
  EXPECT_EQ(names(changed(at_rest, "x1*x2 + y1*y2) - 2*1.4", "x1*x2 + 2*y1*y2) - 2*2.44")), "");
}

/// x of a pair is from the second to the first, whether positions are named besides or not.
TYPED_TEST(FormulaScene, OfPairsHasDisplacementsAndTheirSymmetry) {
  using S = TypeParam;
  const std::string pair = R"(dimension = 2
body = [{ name = "a", mass = 1, position = [0, 0], velocity = [0, 0] },
        { name = "b", mass = 2, position = [3, 4], velocity = [0, 0] }]
effect = [{ kind = "formula", U = "2*x + r^2/10", between = ["a", "b"] }]
)";
  for (const std::string& text : {pair, changed(pair, "2*x +", "2*x + 0*x1 +"), changed(pair, "2*x", "2*x1 - 2*x2")}) {
    const Assembled<S> scene = assembled<S>(text);
    StateEvaluator<S> point(scene.problem);
    const Vector<S> force = point.forces(scene.q0, scene.p0).applied;
    const S expected[] = {2 - S(6) / 10, S(-8) / 10, S(6) / 10 - 2, S(8) / 10};
    for (Index i = 0; i < 4; ++i) EXPECT_LE(magnitude(S(force[i] - expected[i])), 4 * epsilon<S>()) << text;
    EXPECT_EQ(conserved(scene.problem), "P_x, P_y") << text;
  }
}

/// Points and centres of rigid bodies.
TYPED_TEST(FormulaScene, ActsOnRigidBodies) {
  this->expect_near(joined_bodies + "\n[[effect]]\nkind = \"formula\"\nU = \"-m*(2*x - y/3)\"\n",
                    joined_bodies + "\n[[effect]]\nkind = \"uniform_gravity\"\nacceleration = [-2, \"1/3\", 0]\n");
}

/// What a scene with a change of the pendulum is refused with in double.
std::string refused_in_double(const std::string& from, const std::string& to) {
  return inconsistency<double>(changed(pendulum_by_formulas, from, to));
}

TEST(FormulaScenes, AreRefusedAtTheOperationThatHasNoValue) {
  const std::string gravity = "\"-9.81*m*y\"";
  EXPECT_EQ(refused_in_double(gravity, "\"-9.81*m*y + 1/(x - 3/5)\""),
            "test.toml:38: effect 1 (formula): 'U', line 40, column 19: division by 0 at the start");
  EXPECT_EQ(refused_in_double(gravity, "\"-9.81*m*y + log(k - 0.3)*x\""),
            "test.toml:38: effect 1 (formula): 'U', line 40, column 18: logarithm of 0");
  EXPECT_EQ(refused_in_double("charge = \"3/7\"", ""), "test.toml:42: effect 2 (formula): 'a' has no charge");
  EXPECT_EQ(refused_in_double("mass = 3", "mass = [[3, 0], [0, 2]]"),
            "test.toml:38: effect 1 (formula): 'b' has a mass matrix; a scalar mass is needed");
}

TEST(FormulaScenes, AreRefusedIfTheyDoNotSayWhatTheyActOn) {
  for (const auto& [keys, words] : {std::pair("", "the key 'on' is missing"),
                                    {"on = \"a\"\nof = [\"a\"]\n", "give either 'on' or 'of'"},
                                    {"of = [\"pivot\"]\n", "fixed points alone"},
                                    {"of = []\n", "must name a body"},
                                    {"of = [\"a\", \"a\"]\n", "'a' twice"},
                                    {"of = [\"a\", \"c\"]\n", "no body 'c'"}})
    expect_words(refused_in_double("between = [\"a\", \"b\"]\ng", keys + std::string("g")), {words});
  expect_words(refused_in_double("kind = \"formula\"\non", "kind = \"formla\"\non"), {"did you mean 'formula'"});
}

TYPED_TEST(FormulaScene, HasConstraintsThatAreNotQuadratic) {
  using S = TypeParam;
  for (const auto& [g, of_degree] : {std::pair("sqrt(x^2 + y^2) - 1", static_cast<int>(Trace<S>::not_polynomial)),
                                     {"(x^2 + y^2)^2 - 1", 4},
                                     {"x^3 + y^2*x + (x^2 + y^2 - 1)*y - x", 3}}) {
    const Assembled<S> scene = assembled<S>(changed(pendulum_by_formulas, "x^2 + y^2 - 1", g));
    ASSERT_EQ(scene.problem.nu(), 2);
    EXPECT_TRUE(std::holds_alternative<FormulaConstraint<S>>(scene.problem.constraints[0].form)) << g;
    EXPECT_TRUE(std::holds_alternative<Rod<S>>(scene.problem.constraints[1].form)) << g;
    EXPECT_EQ(degree(scene.problem.constraints), of_degree) << g;
  }
}

TEST(FormulaScenes, WithAConstraintThatTheStartMissesAreRefused) {
  EXPECT_EQ(refused_in_double("x^2 + y^2 - 1", "sqrt(x^2 + y^2) - 2").substr(0, 83),
            "test.toml:28: the initial position is not consistent with constraint 1 (formula of ");
  expect_words(refused_in_double("x^2 + y^2 - 1", "x^3 - (3/5)^3"), {"the initial velocity is not consistent"});
  EXPECT_EQ(refused_in_double("x^2 + y^2 - 1", "log(x^2 - 9/25) + y^2 - 1").substr(0, 70),
            "test.toml:28: constraint 1 (formula): 'g', line 31, column 6: logarith");
}

/// And not at a scale whose squares double holds.
TEST(FormulaScenes, WithAGradientWhoseSquareIsBeyondTheRangeAreRefused) {
  for (const std::string g : {"((x^2 + y^2)^2 - 1)*1e", "(x^2 + y^2 - 1)*1e"}) {
    for (const std::string exponent : {"-200", "-158", "200"})
      expect_words(refused_in_double("x^2 + y^2 - 1", g + exponent), {"beyond the range of this precision"});
    for (const std::string exponent : {"-100", "100"})
      EXPECT_EQ(refused_in_double("x^2 + y^2 - 1", g + exponent), "") << g << exponent;
  }
}

/// Clairaut's integral is recognised.
TEST(FormulaScenes, WithASurfaceOfRevolutionConserveItsMomentum) {
  const PrecisionScope digits(50);
  const auto names = [](const char* scene) { return conserved(assemble<Mpfr>(load_scene(scene)).problem); };
  EXPECT_EQ(names("bead_on_torus"), "L_z");
  EXPECT_EQ(names("bead_on_quartic"), "");
  EXPECT_EQ(names("rope_over_two_pegs"), "");
}

/// Of two free bodies, or of the first of them and a second that nothing holds.
TYPED_TEST(FormulaScene, KeepsTheMomentaOfAnyConstraint) {
  const auto names = [](const std::string& constraint) {
    const std::string text = R"(dimension = 3
body = [{ name = "a", mass = 1, position = ["1/2", "1/3", "-1/4"], velocity = [1, 0, 0] },
        { name = "b", mass = 3, position = [-1, "2/3", "1/5"], velocity = [0, 0, 0] }]
[[constraint]]
kind = "formula"
)" + constraint + "\"\n";
    return conserved(assembled<TypeParam>(text, Consistency::unchecked).problem);
  };
  const std::string pair = "between = [\"a\", \"b\"]\ng = \"", all = "P_x, P_y, P_z, L_x, L_y, L_z";
  EXPECT_EQ(names(pair + "sinh(r) - sinh(1)"), all);
  EXPECT_EQ(names(pair + "exp((x1 - x2)^2 + (y1 - y2)^2 + (z1 - z2)^2) - 2"), all);
  EXPECT_EQ(names(pair + "cos(x1 - x2) + (y1 - y2)^4 + z1 - z2"), "P_x, P_y, P_z");
  EXPECT_EQ(names(pair + "cos(x1 - x2) + (y1 - y2)^4 + z1^3 - z2"), "P_x, P_y");
  EXPECT_EQ(names(pair + "sqrt((x1 - x2)^2 + (y1 - y2)^2) + (z1 - z2)^4"), "P_x, P_y, P_z, L_z");
  EXPECT_EQ(names(pair + "sqrt(x1^2 + y1^2 + z1^2) + sqrt(x2^2 + y2^2 + z2^2) - 2"), "L_x, L_y, L_z");
  EXPECT_EQ(names(pair + "x1*y2 - x2*y1 + z1^4"), "L_z");
  const std::string one = "on = \"a\"\ng = \"";
  EXPECT_EQ(names(one + "(x^2 + y^2)^2 + z^4 - 1"), "L_z");
  EXPECT_EQ(names(one + "(x^2 + 1.0000001*y^2)^2 + z^4 - 1"), "");
  EXPECT_EQ(names(one + "(x^2 + y^2 + z^2)^2 - 1"), "L_x, L_y, L_z");
  EXPECT_EQ(names(one + "x^4 + y^4 + z^4 + 2*(x^2*y^2 + y^2*z^2 + x^2*z^2) - 1"), "L_x, L_y, L_z");
  EXPECT_EQ(names(one + "exp(z) - x^3"), "P_y");
  EXPECT_EQ(names(one + "x - cos(z)"), "P_y");
}

/// One that follows from others is set aside, of whatever kind they are. One that does so at the start alone is
/// refused, by its second derivative.
TYPED_TEST(FormulaScene, SetsRedundantConstraintsAside) {
  using S = TypeParam;
  const auto scene = [](const std::string& second) {
    return assembled<S>(R"(dimension = 2
point = [{ name = "O", position = [0, 0] }]
body = [{ name = "a", mass = 1, position = ["3/5", "4/5"], velocity = ["-4/5", "3/5"] }]
)" + rod("O", "a", "1") +
                        "[[constraint]]\nkind = \"formula\"\non = \"a\"\ng = \"" + second + "\"\n");
  };
  for (const char* second : {"sqrt(x^2 + y^2) - 1", "log(x^2 + y^2)", "1/(x^2 + y^2) - 1", "x^4 - (1 - y^2)^2"}) {
    const Problem<S> problem = scene(second).problem;
    EXPECT_EQ(problem.nu(), 1) << second;
    EXPECT_EQ(problem.redundant.size(), 1u) << second;
  }
  for (const char* second : {"3*x/5 + 4*y/5 - 1 + (x - 3/5)^4", "sqrt(x^2 + y^2) - 1 + (4*x - 3*y)^2*sin(x)"}) {
    SCOPED_TRACE(second);
    expect_words(refused([&] { scene(second); }), {"second derivative"});
  }
}

/// A gradient that vanishes, and g that has none, at the start.
TEST(FormulaScenes, WithoutAGradientAreRefused) {
  for (const char* g : {"(sqrt(x^2 + y^2) - 1)^2", "exp(x) - exp(x)", "0*x"})
    expect_words(refused_in_double("x^2 + y^2 - 1", g), {"its gradient vanishes"});
  expect_words(refused_in_double("x^2 + y^2 - 1", "sqrt(x^2 - 9/25) + y - 4/5"), {"test.toml:28: constraint 1"});
}

TEST(FormulaScenes, ReadBackAsTheyAreWritten) {
  const std::string group = changed(pendulum_by_formulas, "center = \"pivot\"\non = [\"b\"]\nU = \"-2/2*r^2\"",
                                    "of = [\"a\", \"b\"]\nU = '''\n a.x*b.y\n - m2*k'''");
  for (const std::string& text : {pendulum_by_formulas, group}) {
    const Scene scene = read_scene(text, "test.toml");
    const std::string written = write_scene(scene);
    EXPECT_EQ(write_scene(read_scene(written, "test.toml")), written);
    EXPECT_EQ(assembled<double>(written).problem.potential.terms.size(), 3u);
  }
}

/// Any text is a formula or refused with one line; what is one has a finite value or is refused. Half a million
/// texts with HBVM_FULL in the environment, some minutes.
TEST(FormulaScenes, OfRandomTextsAreReadOrRefused) {
  const bool all = std::getenv("HBVM_FULL") != nullptr;
  const long texts = all ? 500'000 : 5'000;
  const std::vector<std::string> words{
      "x",    "y",     "m",     "Q",      "r",     "k",  "L", "x1", "a.x", "sqrt(", "sin(",    "cos(", "tan(", "exp(",
      "log(", "sinh(", "cosh(", "tanh(",  "atan(", "pi", "(", ")",  "+",   "-",     "*",       "/",    "^",    "1",
      "0",    "0.5",   "1e9",   "1e-400", ".",     ",",  " ", "\t", "1/3", "999",   "\\u0000", "\\n"};
  std::mt19937 random(17);
  std::size_t read = 0, others = 0;
  for (long n = 0; n < texts; ++n) {
    std::string text;
    const bool sensible = random() % 2 == 0;
    for (unsigned length = 1 + random() % 24; length > 0; --length) {
      // Of operand and operator in turn more come through.
      if (sensible)
        text += words[random() % 8] + words[22 + random() % 5];
      else
        text += words[random() % words.size()];
    }
    if (sensible) text += "x";
    try {
      const Assembled<double> scene =
          assembled<double>(changed(pendulum_by_formulas, "\"-9.81*m*y\"", "\"" + text + "\""));
      StateEvaluator<double> point(scene.problem);
      EXPECT_TRUE(is_finite(point.energy(scene.q0, scene.p0))) << text;
      ++read;
    } catch (const InputError& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
      ++others;
    }
  }
  EXPECT_GT(read, 20u);
  EXPECT_GT(others, 20u);
}

/// Deep, long and steep texts end with an error, soon.
TEST(FormulaScenes, OfHugeTextsAreRefused) {
  const auto of = [](const std::string& text) { return refused_in_double("\"-9.81*m*y\"", "\"" + text + "\""); };
  std::string deep, steep = "x", long_sum = "x";
  for (int i = 0; i < 50'000; ++i) deep += "(";
  expect_words(of(deep + "x"), {"nested too deeply"});
  for (int i = 0; i < 10; ++i) steep = "(" + steep + ")^999";
  EXPECT_NE(of("exp(2*x)*" + steep + "/x^999").size(), 0u);
  for (int i = 0; i < 2'000; ++i) long_sum += "+x";
  expect_words(of(long_sum), {"too many operations"});
  expect_words(of(std::string(200'000, ' ')), {"too long"});
}

}  // namespace
}  // namespace hbvm::core
