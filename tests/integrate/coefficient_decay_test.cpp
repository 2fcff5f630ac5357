#include "integrate/coefficient_decay.hpp"

#include "integrate/runs.hpp"
#include "printing.hpp"
#include "step/backward_stepper.hpp"

namespace hbvm::core {
namespace {

template <Scalar S>
struct Watched {
  SceneRun<S> run;
  CoefficientDecay<S> decay;
  Watched(const Scene& text, int s, const char* step, const char* until)
      : run(text, 2 * s, s, step, until), decay(run.scene.problem, s, run.grid.step()) {}
  typename CoefficientDecay<S>::Worst operator()() {
    run({}, &decay);
    return decay.worst(run.state.q);
  }
};

CoefficientDecay<double>::Worst worst(const std::string& text, int s, const char* step, const char* until) {
  return Watched<double>(read_scene(text, "scene"), s, step, until)();
}

/// gamma_s = h xi_s (psi_{s-1} - zeta_{s-1}), xi_s = 1/(2 sqrt(4 s^2 - 1)).
TEST(CoefficientDecay, ComparesTheNeglectedCoefficientWithThoseThatVary) {
  const PrecisionScope digits(50);
  for (const int s : {2, 3, 5}) {
    Watched<Mpfr> one(load_scene("double_pendulum"), s, "1/8", "1/8");
    const double ratio = one().ratio;
    const StageUnknowns<Mpfr>& x = one.run.stepper.solver().unknowns();
    double expected = 0;
    for (Index offset : {0, 2}) {
      const auto size = [&](const auto& row) { return max_norm(Vector<Mpfr>(row.segment(offset, 2))); };
      Mpfr neglected = size((x.psi.row(s - 1) - x.zeta.row(s - 1)).transpose()) * one.run.grid.step();
      neglected /= 2 * sqrt(Mpfr(4 * s * s - 1));
      Mpfr varying = neglected;
      for (int j = 1; j < s; ++j) varying += size(x.gamma.row(j).transpose());
      raise_to(expected, approximately(Mpfr(neglected / varying)));
    }
    EXPECT_NEAR(ratio / expected, 1, 1e-12) << s;
  }
}

/// cos(x t) has the coefficients sqrt(2j+1) times Bessel's functions: for s = 2 the ratio is about x/8 a step.
TEST(CoefficientDecay, OfAnOscillatorGrowsWithTheStep) {
  const std::string oscillator =
      "dimension = 2\npoint = [{name = \"o\", position = [0, 0]}]\n"
      "body = [{name = \"b\", mass = 3, position = [1, 0], velocity = [0, 1]}]\n"
      "effect = [{kind = \"spring\", between = [\"o\", \"b\"], stiffness = 3}]\n";
  for (const auto& [step, x] : {std::pair("1/64", 1 / 64.0), {"1/8", 1 / 8.0}})
    EXPECT_NEAR(worst(oscillator, 2, step, "8").ratio, x / (2 * std::sqrt(15)), 0.1 * x / 8);
  EXPECT_NEAR(worst(oscillator, 1, "1/16", "8").ratio, 1 / 16.0, 1 / 160.0);
}

const std::string free_beside_bound =
    "dimension = 2\n[constants]\nlight = \"1e-12\"\n[[point]]\nname = \"sun\"\nposition = [0, 0]\n"
    "[[body]]\nname = \"heavy\"\nmass = 1\nposition = [0, 10]\nvelocity = [1, 0]\n"
    "[[body]]\nname = \"light\"\nmass = \"light\"\nposition = [\"1/2\", 0]\nvelocity = [0, \"sqrt(3)\"]\n"
    "[[effect]]\nkind = \"central_gravity\"\ncenter = \"sun\"\nstrength = 1\non = [\"light\"]\n";

/// The way back from (q, p) is the way from (q, -p).
TEST(CoefficientDecay, OfARunBackIsThatOfTheReversedOne) {
  for (const int s : {1, 2, 3}) {
    Watched<double> reversed(load_scene("double_pendulum"), s, "1/8", "2"),
        back(load_scene("double_pendulum"), s, "1/8", "2");
    reversed.run.state.p = -reversed.run.state.p;
    BackwardStepper<double> stepper(back.run.stepper);
    integrate<double>(stepper, back.run.state, back.run.grid, {}, nullptr, &back.decay);
    EXPECT_EQ(back.decay.worst(back.run.state.q).ratio, reversed().ratio) << s;
    EXPECT_GT(reversed.decay.worst(back.run.state.q).ratio, 0) << s;
  }
}

TEST(CoefficientDecay, OfALightBodyIsNotHiddenByAHeavyOne) {
  for (const int s : {1, 2}) {
    const auto large = worst(free_beside_bound, s, "2*pi/16", "2*pi"),
               small = worst(free_beside_bound, s, "pi/64", "pi");
    const int limit = s == 1 ? 2 : 8;
    EXPECT_GT(large.ratio * limit, 1) << s;
    EXPECT_EQ(large.offset, 2) << s;
    EXPECT_LT(small.ratio * limit, 1) << s;
  }
}

TEST(CoefficientDecay, OfWhatDoesNotTurnIsNothing) {
  const std::string head = "dimension = 2\nbody = [{name = \"b\", mass = 3, position = [1, 2], velocity = [";
  const std::string gravity = "effect = [{kind = \"uniform_gravity\", acceleration = [0, -1]}]\n";
  const std::string held =
      "point = [{name = \"o\", position = [1, 3]}]\n"
      "constraint = [{kind = \"rod\", between = [\"o\", \"b\"], length = 1}]\n";
  for (const int s : {1, 2, 3}) {
    EXPECT_EQ(worst(head + "1, 2]}]\n", s, "1/4", "8").ratio, 0) << "free, " << s;
    EXPECT_LT(worst(head + "0, 0]}]\n" + gravity, s, "1/4", "8").ratio, 1e-3) << "falling from rest, " << s;
    EXPECT_LT(worst(head + "0, 0]}]\n" + gravity + held, s, "1/4", "8").ratio, 0.01) << "at rest, " << s;
    const std::string springs =
        "point = [{name = \"l\", position = [0, 2]}, {name = \"r\", position = [\"18/11\", 2]}]\n"
        "effect = [{kind = \"spring\", between = [\"l\", \"b\"], stiffness = \"7/3\"},\n"
        "{kind = \"spring\", between = [\"r\", \"b\"], stiffness = \"11/3\"}]\n";
    EXPECT_LT(worst(head + "0, 0]}]\n" + springs, s, "1/4", "8").ratio, 0.01) << "between springs, " << s;
  }
}

}  // namespace
}  // namespace hbvm::core
