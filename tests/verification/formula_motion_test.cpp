// Motions under formulas that must be the same: of the same constraint said in another way, in other units, by more
// nodes than it takes.

#include "printing.hpp"
#include "problem/state_evaluator.hpp"
#include "reference/closed_form/rigid_scenes.hpp"
#include "scalar/binary_exponent.hpp"
#include "scene/formula_scene.hpp"
#include "step/hbvm_method.hpp"
#include "step/stepping.hpp"

namespace hbvm::core {
namespace {

template <class S>
class FormulaMotion : public InDigits<40> {
 protected:
  static Assembled<S> assembled(const std::string& text) { return assemble<S>(read_scene(text, "test.toml")); }
};
TYPED_TEST_SUITE(FormulaMotion, AllScalars, ScalarNames);

/// A formula of degree 2 is the rod that it says, to the last bit of the motion, with more nodes than stages, too.
TYPED_TEST(FormulaMotion, OfDegree2HasTheBitsOfRods) {
  using S = TypeParam;
  const Assembled<S> formulas = this->assembled(pendulum_by_formulas), rods = this->assembled(pendulum_as_built_in);
  for (const char* method : {"hbvm:2,2", "hbvm:5,3", "hbvm:2,2,4", "rattle", "lobatto:3", "energy_momentum"}) {
    const State<S> a = after(method, formulas, S(1) / 32, 12, SolverKind::automatic),
                   b = after(method, rods, S(1) / 32, 12, SolverKind::automatic);
    EXPECT_EQ(a.q, b.q) << method;
    EXPECT_EQ(a.p, b.p) << method;
    EXPECT_NE(a.q, formulas.q0);
  }
}

/// A scene in other units, powers of two; its constraints times numbers.
struct Units {
  int length, mass, time, first, second;
  std::string text() const {
    const auto power = [](const char* name, int n) {
      return std::string(name) + " = \"2^(" + std::to_string(n) + ")\"\n";
    };
    return "dimension = 3\n[constants]\n" + power("L", length) + power("M", mass) + power("T", time) +
           power("G", first) + power("F", second);
  }
};
std::string bead_on(const std::string& g) {
  return "[[constraint]]\nkind = \"formula\"\non = \"bead\"\ng = \"" + g + "\"\n";
}
const std::string torus_in_units = body("bead", "\"M\"", "[\"3*L\", 0, 0]", "[0, \"L/T\", \"L/(2*T)\"]") +
                                   bead_on("G*((sqrt(x^2 + y^2) - 2*L)^2 + z^2 - L^2)") +
                                   field("[\"L/(4*T^2)\", 0, \"-L/T^2\"]");
const std::string helix_in_units = body("bead", "\"M\"", "[\"L\", 0, 0]", "[0, \"3*L/(2*T)\", \"3*L/(2*T)\"]") +
                                   bead_on("G*(x - L*cos(z/L))") + bead_on("F*(y - L*sin(z/L))") +
                                   field("[0, 0, \"-L/T^2\"]");

/// Neither iteration, nor its end, nor a pivot depends on units or on how large the constraints are written. If one of
/// two is written large and the other small, other pivots may round otherwise.
TYPED_TEST(FormulaMotion, HasTheSameBitsInAllUnits) {
  using S = TypeParam;
  for (const bool helix : {false, true}) {
    const std::string scene = helix ? helix_in_units : torus_in_units;
    const Assembled<S> plain = this->assembled(Units{0, 0, 0, 0, 0}.text() + scene);
    for (const Units& units : {Units{10, 0, 0, 0, 0},
                               {0, -20, 0, 0, 0},
                               {0, 0, 5, 0, 0},
                               {0, 0, 0, 30, 30},
                               {0, 0, 0, -40, 30},
                               {-9, 17, 4, -25, -25}}) {
      const Assembled<S> other = this->assembled(units.text() + scene);
      const S length = power_of_two<S>(-units.length), time = power_of_two<S>(units.time),
              momentum = power_of_two<S>(units.time - units.mass - units.length);
      const S h = S(1) / 16, allowed = units.first == units.second ? S(0) : S(64 * epsilon<S>());
      for (const char* method : {"hbvm:2,2,2", "hbvm:3,2,4", "rattle", "lobatto:3"})
        for (const SolverKind solver : {SolverKind::newton, SolverKind::fixed_point}) {
          const State<S> expected = after(method, plain, h, 6, solver),
                         found = after(method, other, time * h, 6, solver);
          const std::string what = scene + method + ' ' + std::string(name_of(solver)) + '\n' + units.text();
          EXPECT_LE(max_norm(Vector<S>(length * found.q - expected.q)), allowed) << what;
          EXPECT_LE(max_norm(Vector<S>(momentum * found.p - expected.p)), allowed) << what;
        }
    }
  }
}

/// Of g of degree d the sums over the nodes have terms of degree d s + s - 2. From r = (d s + s - 1)/2 on all r are one
/// method but for rounding. r = d s/2, which keeps g, is another.
TYPED_TEST(FormulaMotion, OfAPolynomialDependsOnNoNodesBeyondItsDegree) {
  using S = TypeParam;
  const Assembled<S> quartic = assemble<S>(load_scene("bead_on_quartic")),
                     rods = assemble<S>(load_scene("double_pendulum"));
  const auto apart = [&](const Assembled<S>& scene, int s, int r) {
    const auto name = [&](int nodes) { return "hbvm:5," + std::to_string(s) + "," + std::to_string(nodes); };
    const State<S> a = after(name(r), scene, S(1) / 32, 4, SolverKind::automatic),
                   b = after(name(r + 3), scene, S(1) / 32, 4, SolverKind::automatic);
    return S(distance(a.q, b.q) + distance(a.p, b.p));
  };
  const S rounding = 512 * epsilon<S>(), distinct = 1'000'000 * epsilon<S>();
  for (const auto& [s, enough] : {std::pair(1, 2), {2, 5}, {3, 7}}) {
    EXPECT_LE(apart(quartic, s, enough), rounding) << s;
    EXPECT_LE(apart(rods, s, (3 * s) / 2), rounding) << s;
  }
  EXPECT_GT(apart(quartic, 1, 1), distinct);
  EXPECT_GT(apart(quartic, 2, 3), distinct);
  EXPECT_GT(apart(rods, 2, 2), distinct);
}

/// r = d s/2 keeps g to rounding over a thousand steps, one node less loses it.
TYPED_TEST(FormulaMotion, KeepsAPolynomialWithAsManyNodesAsItTakes) {
  using S = TypeParam;
  const Assembled<S> scene = assemble<S>(load_scene("bead_on_quartic"));
  const long steps = std::same_as<S, double> ? 1000 : 100;
  for (const int s : {1, 2, 3})
    for (const int r : {2 * s, 2 * s - 1}) {
      if (r < s) continue;
      const auto stepper = HbvmMethod({s, s, r}).make_stepper(scene.problem, SolverKind::automatic);
      State<S> state(scene.q0, scene.p0);
      StateEvaluator<S> point(scene.problem);
      S greatest = 0;
      for (long n = 0; n < steps; ++n) {
        stepper->step(state, S(S(s) / 16));
        raise_to(greatest, max_norm(point.constraints(state.q)));
      }
      // Four terms of up to 1 and as many of their slopes.
      if (r == 2 * s)
        EXPECT_LE(greatest, 64 * epsilon<S>()) << s;
      else
        EXPECT_GT(greatest, 1'000'000 * epsilon<S>()) << s;
    }
}

/// A point of a rigid body, whose weights are those of its place, on a surface by a formula. It has the same motion as
/// by a rod, which is quadratic, at order 2s in all components.
TEST(FormulaMotionOfARigidBody, IsThatOfTheSameRod) {
  const PrecisionScope digits(40);
  const RigidScene stone{.position = "[1, 0, 0]",
                         .velocity = "[0, 0, 0]",
                         .mass = "\"3/2\"",
                         .center = "[\"1/9\", 0, \"1/10\"]",
                         .second_moment = "[[1, 0, 0], [0, \"7/5\", 0], [0, 0, \"4/5\"]]",
                         .directors = "[[1, 0, 0], [0, 1, 0], [0, 0, 1]]",
                         .omega = "[0, 0, 0]",
                         .more = point("O", "[\"1/5\", 0, \"2/7\"]") + field("[0, \"1/3\", -1]") +
                                 "[[attachment]]\nname = \"eye\"\nof = \"body\"\nat = [\"1/2\", \"-1/3\", \"1/7\"]\n"};
  const std::string square = "(13/10)^2 + 1/9 + 1/49";
  const std::string by_length =
      "[[constraint]]\nkind = \"formula\"\nbetween = [\"eye\", \"O\"]\ng = \"r - sqrt(" + square + ")\"\n";
  const auto held = assemble<Mpfr>(read_scene(stone.text() + rod("eye", "O", "\"sqrt(" + square + ")\""), "rod"));
  const auto general = assemble<Mpfr>(read_scene(stone.text() + by_length, "r"));
  ASSERT_EQ(degree(held.problem.constraints), 2);
  ASSERT_NE(degree(general.problem.constraints), 2);
  const auto end = [](const Assembled<Mpfr>& scene, const char* method, int steps) {
    State<Mpfr> state = after(method, scene, Mpfr(1) / 2 / steps, steps, SolverKind::automatic);
    StateEvaluator<Mpfr> point(scene.problem);
    state.p = point.tangential(state.q, state.p);
    return state;
  };
  const State<Mpfr> exact = end(held, "hbvm:12,12", 8);
  for (const auto& [method, order] : {std::pair("hbvm:1,1,4", 2), {"hbvm:2,2,5", 4}, {"hbvm:3,3,6", 6}}) {
    Mpfr error[2];
    for (const int i : {0, 1}) {
      const State<Mpfr> found = end(general, method, 8 << i);
      error[i] = distance(found.q, exact.q) + distance(found.p, exact.p);
    }
    EXPECT_NEAR(order_of(error[0], error[1]), order, 0.2) << method;
  }
}

/// The cycloid with more speed than its arch allows: the bead comes to the cusp at z = 1, where the formula ends. No
/// method steps over it and says nothing.
TYPED_TEST(FormulaMotion, EndsWithATypedErrorWhereTheFormulaEnds) {
  using S = TypeParam;
  const std::string text = "dimension = 3\n" + body("bead", "1", "[0, 0, 0]", "[4, 0, 1]") +
                           bead_on("x - 2*atan(z/sqrt(1 - z^2)) - 2*z*sqrt(1 - z^2)") + bead_on("y - 2*z^2");
  const Assembled<S> scene = this->assembled(text);
  // Without gravity z = t.
  for (const char* method : {"hbvm:1,1", "hbvm:2,2,4", "hbvm:4,4", "rattle", "lobatto:3", "compose:rattle,4"})
    for (const SolverKind solver : {SolverKind::newton, SolverKind::fixed_point, SolverKind::automatic}) {
      EXPECT_NO_THROW(after(method, scene, S(1) / 16, 12, solver)) << method;
      EXPECT_THROW(after(method, scene, S(1) / 16, 32, solver), Error) << method << ' ' << name_of(solver);
    }
}

}  // namespace
}  // namespace hbvm::core
