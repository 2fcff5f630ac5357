#include "run/choose_k.hpp"

#include <csignal>

#include "hbvm/error.hpp"
#include "interrupting.hpp"
#include "printing.hpp"
#include "problem/general_drift.hpp"
#include "run/scene_run.hpp"
#include "run/simulate.hpp"
#include "runs/request_of.hpp"
#include "scene/scene_text.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

std::string with(const std::vector<std::string>& effects, const std::string& velocity) {
  std::string text =
      "dimension = 2\npoint = [{ name = \"O\", position = [0, 0] }]\n"
      "body = [{ name = \"a\", mass = 1, position = [1, 0], velocity = " +
      velocity + " }]\n";
  for (const std::string& effect : effects) text += "[[effect]]\n" + effect + "\n";
  return text;
}
const std::string gravity = "kind = \"uniform_gravity\"\nacceleration = [0, -1]",
                  central_attraction = "kind = \"central_gravity\"\ncenter = \"O\"\nstrength = 1";
std::string spring(const std::string& exponent, const std::string& length = "0") {
  return "kind = \"spring\"\nbetween = [\"a\", \"O\"]\nstiffness = 1\nexponent = " + exponent +
         "\nrest_length = " + length;
}

template <Scalar S>
Assembled<S> assembled(const std::vector<std::string>& effects, const std::string& velocity = "[0, 1]") {
  return assemble<S>(read_scene(with(effects, velocity), "test.toml"));
}

std::optional<int> degree(const std::vector<std::string>& effects) {
  return degree_of_U(assembled<double>(effects).problem);
}

/// It may try a thousand nodes, for minutes.
TEST(ChooseK, IsEndedByASignal) {
  const Assembled<double> scene = assembled<double>({central_attraction});
  interruption = SIGTERM;
  EXPECT_THROW(choose_k(scene, HbvmName{0, 2, 0}, 1.0 / 8, SolverKind::automatic), Interrupted);
  interruption = 0;
}

TEST(DegreeOfU, IsTheGreatestOfItsEffects) {
  EXPECT_EQ(degree({}), 0);
  EXPECT_EQ(degree({gravity}), 1);
  EXPECT_EQ(degree({spring("2")}), 2);
  EXPECT_EQ(degree({spring("6"), gravity, spring("4")}), 6);
}

TEST(DegreeOfU, IsNoneIfOneEffectIsNoPolynomial) {
  EXPECT_EQ(degree({central_attraction}), std::nullopt);
  EXPECT_EQ(degree({gravity, central_attraction, spring("4")}), std::nullopt);
  EXPECT_EQ(degree({spring("3")}), std::nullopt);       // |r|^3
  EXPECT_EQ(degree({spring("2", "1")}), std::nullopt);  // a rest length takes the root
}

template <class S>
class ChooseK : public InDigits<50> {
 protected:
  static ChosenK chosen(const Assembled<S>& scene, int s, const char* step) {
    return choose_k<S>(scene, HbvmName{0, s}, literal<S>(step), SolverKind::fixed_point);
  }
  static S energy_error(const Assembled<S>& scene, int k, int s, const char* step, const char* until) {
    return simulate(scene, make_hbvm<S>(k, s), SolverKind::fixed_point,
                    TimeGrid<S>(Expression::parse(step), Expression::parse(until)))
        .e_H;
  }
};
TYPED_TEST_SUITE(ChooseK, AllScalars, ScalarNames);

/// k >= mu s/2, (51), and k >= s.
TYPED_TEST(ChooseK, ForAPolynomialIsTheLeastOfTheTheory) {
  struct Case {
    std::vector<std::string> effects;
    int s, k;
  };
  for (const Case& c : std::vector<Case>{{{}, 3, 3},
                                         {{gravity}, 1, 1},
                                         {{gravity}, 4, 4},
                                         {{spring("2"), gravity}, 2, 2},
                                         {{spring("4")}, 1, 2},
                                         {{spring("4"), gravity}, 3, 6},
                                         {{spring("6")}, 1, 3},
                                         {{spring("6"), spring("2")}, 3, 9}}) {
    const ChosenK chosen = this->chosen(assembled<TypeParam>(c.effects), c.s, "1/8");
    EXPECT_EQ(chosen.k, c.k) << "s = " << c.s;
    expect_words(chosen.reason, {"conserves energy exactly"});
  }
}

/// No effect of today has an odd degree above 1, for which s nodes do; should one come, half of mu s is rounded up.
TYPED_TEST(ChooseK, ForAPolynomialOfOddDegreeRoundsUp) {
  auto scene = assembled<TypeParam>({spring("4")});
  for (const auto& [degree, s, k] : {std::tuple(3, 1, 2), {3, 2, 3}, {3, 3, 5}, {5, 1, 3}, {5, 3, 8}, {1, 3, 3}}) {
    scene.problem.potential.terms[0].degree = degree;
    EXPECT_EQ(degree_of_U(scene.problem), degree);
    EXPECT_EQ(this->chosen(scene, s, "1/8").k, k) << "degree " << degree << ", s = " << s;
  }
}

TYPED_TEST(ChooseK, ForAPolynomialConservesEnergyAndOneNodeLessDoesNot) {
  for (const auto& [exponent, s] : {std::pair("4", 1), {"4", 2}, {"6", 1}}) {
    const auto scene = assembled<TypeParam>({spring(exponent)}, "[0.5, 0.75]");
    const int k = this->chosen(scene, s, "1/8").k;
    EXPECT_LE(this->energy_error(scene, k, s, "1/8", "2"), 1'000 * epsilon<TypeParam>()) << exponent << " " << s;
    EXPECT_GT(this->energy_error(scene, k - 1, s, "1/8", "2"), literal<TypeParam>("1e-11")) << exponent << " " << s;
  }
}

/// r >= d s/2 for g of degree d, and none to be chosen if all are quadratic.
TYPED_TEST(ChooseK, OfPolynomialConstraintsIsTheLeastOfTheTheory) {
  using S = TypeParam;
  for (const int s : {1, 3}) {
    const ChosenK quartic = this->chosen(assemble<S>(load_scene("bead_on_quartic")), s, "1/16");
    EXPECT_EQ(quartic.r, 2 * s);
    EXPECT_EQ(quartic.raises, Raises::k);
    expect_words(quartic.reason, {"g is a polynomial of degree 4"});
    const ChosenK rods = this->chosen(assemble<S>(load_scene("double_pendulum")), s, "1/16");
    EXPECT_EQ(rods.r, 0);
    EXPECT_EQ(rods.reason.find("g is"), std::string::npos) << rods.reason;
  }
}

/// With r nodes 16 steps move g by a unit of round-off at most, with one less some by more.
TYPED_TEST(ChooseK, OfOtherConstraintsIsTheLeastThatKeepsThem) {
  using S = TypeParam;
  const S step = literal<S>("1/8");
  for (const char* name : {"bead_on_torus", "bead_on_helix", "rope_over_two_pegs"}) {
    const auto scene = assemble<S>(load_scene(name));
    const ChosenK chosen = this->chosen(scene, 2, "1/8");
    EXPECT_EQ(chosen.k, 2) << "U is linear, or 0";
    EXPECT_FALSE(chosen.exact);
    EXPECT_EQ(chosen.raises, Raises::k_and_r);
    ASSERT_GT(chosen.r, 2) << name;
    for (const int r : {chosen.r, chosen.r - 1}) {
      const Hbvm<S> method = make_hbvm<S>(2, 2, r);
      HbvmStepper<S> stepper(scene.problem, method, SolverKind::fixed_point);
      State<S> state(scene.q0, scene.p0);
      GeneralDrift<S> drift(scene.problem);
      S greatest = 0;
      for (int n = 0; n < 16; ++n) {
        drift.start(state.q);
        stepper.step(state, step);
        raise_to(greatest, drift.in_units(state.q));
      }
      EXPECT_EQ(greatest <= 1, r == chosen.r) << name << ' ' << r << ' ' << greatest;
    }
    // What the name says is not chosen.
    const ChosenK named = choose_k<S>(scene, HbvmName{0, 2, 3}, step, SolverKind::fixed_point);
    EXPECT_EQ(named.r, 3);
    EXPECT_EQ(named.raises, Raises::k);
  }
}

/// mu s/2 = 100 s is more than max_k.
TYPED_TEST(ChooseK, OfALargePolynomialIsRefused) {
  EXPECT_THROW(this->chosen(assembled<TypeParam>({spring("200")}), 20, "1/8"), InputError);
  EXPECT_EQ(this->chosen(assembled<TypeParam>({spring("200")}), 10, "1/8").k, 1'000);
}

/// Across r = 9/10, where |r - 9/10|^3 is not smooth, quadrature gains little from more nodes.
TEST(ChooseK, WhereNoKIsEnoughSaysSo) {
  const auto scene = assembled<double>({spring("3", "0.9")}, "[-1, \"1/100\"]");
  expect_words(message_of([&] {
                 choose_k<double>(scene, HbvmName{0, 2}, 0.25, SolverKind::fixed_point);
               }),
               {"hbvm:auto,2", "998", "not smooth"});
}

/// The definition itself, step by step: at the chosen k all defects are round-off, at one less some are not.
TYPED_TEST(ChooseK, OtherwiseIsTheLeastThatReachesRoundOff) {
  using S = TypeParam;
  constexpr int s = 2;
  const S step = literal<S>("1/16");
  const auto scene = assembled<S>({central_attraction});
  const ChosenK chosen = this->chosen(scene, s, "1/16");
  expect_words(chosen.reason, {"not a polynomial"});
  ASSERT_GT(chosen.k, s);
  for (const int k : {chosen.k, chosen.k - 1}) {
    const Hbvm<S> method = make_hbvm<S>(k, s);
    HbvmStepper<S> stepper(scene.problem, method, SolverKind::fixed_point);
    State<S> state(scene.q0, scene.p0);
    bool enough = true;
    for (int n = 0; n < 16; ++n) {
      enough = enough && quadrature_defect(scene.problem, k, s, step, SolverKind::fixed_point, state.q, state.p) <= 1;
      stepper.step(state, step);
    }
    EXPECT_EQ(enough, k == chosen.k) << "k = " << k;
  }
}

TYPED_TEST(ChooseK, OtherwiseConservesEnergyToRoundOff) {
  const auto scene = assembled<TypeParam>({central_attraction, gravity});
  const int k = this->chosen(scene, 1, "1/32").k;
  EXPECT_LE(this->energy_error(scene, k, 1, "1/32", "1/2"), 1'000 * epsilon<TypeParam>());
  EXPECT_GT(this->energy_error(scene, 1, 1, "1/32", "1/2"), literal<TypeParam>("1e-6"));
}

/// From the apocentre of a long orbit the first steps need few nodes, and the passage of the pericentre in the last
/// ones many. The choice hbvm:auto must conserve energy through it.
TEST(ChosenK, ServesTheWholeRunAndNotItsFirstStepAlone) {
  const Scene scene = read_scene(with({central_attraction}, "[0, \"sqrt(3/5)\"]"), "ellipse");  // excentricity 2/5
  for (const char* precision : {"double", "quad"}) {
    const hbvm::Run result = run(request_of(scene, "hbvm:auto,1", "1/8", "2", precision, SolverKind::fixed_point), {});
    EXPECT_LE(std::stod(result.e_H), 1'000 * (std::string(precision) == "double" ? 2.2e-16 : 1.9e-34))
        << precision << ", k = " << result.method;
  }
}

TYPED_TEST(ChooseK, SmallerStepsNeedFewerNodes) {
  const auto scene = assembled<TypeParam>({central_attraction});
  const int most = this->chosen(scene, 1, "1/4").k, middle = this->chosen(scene, 1, "1/16").k,
            least = this->chosen(scene, 1, "1/256").k;
  EXPECT_LT(least, middle);
  EXPECT_LT(middle, most);
}

TYPED_TEST(ChooseK, DefectOfAConstantForceIsZero) {
  using S = TypeParam;
  const auto scene = assembled<S>({gravity});
  EXPECT_EQ(quadrature_defect(scene.problem, 2, 2, S(S(1) / 8), SolverKind::fixed_point, scene.q0, scene.p0), 0);
}

/// On the line (1, t) of the first step one node misses h^2/24 f'' = h^2/8 of the mean force, of size 1. Round-off is
/// 16 (k + s) epsilon = 32 epsilon of that size.
TYPED_TEST(ChooseK, DefectIsMeasuredInRoundOff) {
  using S = TypeParam;
  const auto scene = assembled<S>({central_attraction});
  const S h = literal<S>("1/1024");
  const S defect = quadrature_defect(scene.problem, 1, 1, h, SolverKind::fixed_point, scene.q0, scene.p0);
  EXPECT_NEAR(approximately(S(defect * 32 * epsilon<S>() / (h * h))), 1.0 / 8, 1e-3);
}

TYPED_TEST(ChooseK, OfAStepThatCannotBeMadeIsAnIntegrationError) {
  EXPECT_THROW(this->chosen(assembled<TypeParam>({central_attraction}, "[0, 0]"), 1, "20"), StepError);
}

/// A stone falls into the center within the first steps. Whatever comes before is integrated by a k that is enough for
/// it, and the run ends where it must.
TYPED_TEST(ChooseK, OfALaterStepThatCannotBeMadeIsThatOfTheStepsBefore) {
  using S = TypeParam;
  const auto scene = assembled<S>({central_attraction}, "[0, 0]");
  const ChosenK chosen = this->chosen(scene, 2, "1/8");
  expect_words(chosen.reason, {"no k makes more than the first"});
  const Hbvm<S> method = make_hbvm<S>(chosen.k, 2);
  HbvmStepper<S> stepper(scene.problem, method, SolverKind::fixed_point);
  State<S> state(scene.q0, scene.p0);
  stepper.step(state, literal<S>("1/8"));
}

/// A stiff spring amplifies the round-off of positions. That no k agrees with k + s to the round-off of its force alone
/// is no lack of nodes.
TEST(ChooseK, TakesAmplifiedRoundOffForWhatItIs) {
  for (const char* stiffness : {"10^4", "10^6", "10^8"}) {
    const auto scene = assembled<double>({"kind = \"spring\"\nbetween = [\"a\", \"O\"]\nstiffness = \"" +
                                          std::string(stiffness) + "\"\nrest_length = 1"},
                                         "[\"1/100\", \"1/3\"]");
    const double step = 1 / std::sqrt(literal<double>(stiffness)) / 4;
    EXPECT_LE(choose_k<double>(scene, HbvmName{0, 2}, step, SolverKind::automatic).k, 12) << stiffness;
  }
}

}  // namespace
}  // namespace hbvm::core
