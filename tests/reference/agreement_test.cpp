#include "reference/agreement.hpp"

#include <limits>

#include "method/perturbation.hpp"
#include "printing.hpp"
#include "problem/state_evaluator.hpp"
#include "reference/scene_tables.hpp"
#include "step/hbvm_stepper.hpp"

namespace hbvm::core {
namespace {

constexpr unsigned working = 55;
constexpr int wanted = 35;

const std::vector<Expression>& times() {
  static const std::vector<Expression> result{Expression::parse("1/2"), Expression::parse("2")};
  return result;
}

std::vector<Mpfr> instants() { return {literal<Mpfr>("1/2"), Mpfr(2)}; }

/// In one leg of all digits, which does not make its scene anew.
RouteRun by_taylor(const Assembled<Mpfr>& scene) {
  return taylor_route({{}, scene, instants(), [](double) {}, {working}});
}

RouteRun by_hbvm(const Assembled<Mpfr>& scene) {
  return hbvm_route({{}, scene, instants(), [](double) {}, {working}}, 3);
}

/// What runs are refused with that do not agree.
Disagreement disagreement_of(const Agreement& agreement) {
  EXPECT_FALSE(agreement.holds());
  try {
    agreement.require();
  } catch (const Disagreement& found) {
    return found;
  }
  throw Error("the routes agree");
}

/// That the routes differ, at some time and in some component, is said with what each has there.
void expect_found(const Scene& text, const RouteRun& taylor, const RouteRun& hbvm, long least, long most) {
  const Agreement agreement(assemble<Mpfr>(text), times(), {{"taylor", taylor}, {"hbvm", hbvm}}, wanted);
  EXPECT_GE(agreement.digits(), least);
  EXPECT_LE(agreement.digits(), most);
  const Disagreement found = disagreement_of(agreement);
  const std::string message = found.what();
  EXPECT_TRUE(found.t == "1/2" || found.t == "2") << found.t;
  ASSERT_EQ(found.values.size(), 2u);
  EXPECT_EQ(found.values[0].route, "taylor");
  EXPECT_EQ(found.values[1].route, "hbvm");
  EXPECT_NE(found.values[0].number, found.values[1].number) << message;
  expect_words(message, {"t = " + found.t, found.component + " is ", found.values[0].number + " by taylor",
                         found.values[1].number + " by hbvm", std::string("nothing is given out")});
}

/// The same if either route has a wrong scene, and nothing if neither has.
void expect_found(const Scene& text, const Assembled<Mpfr>& right, const Assembled<Mpfr>& wrong, long least,
                  long most) {
  expect_found(text, by_taylor(wrong), by_hbvm(right), least, most);
  expect_found(text, by_taylor(right), by_hbvm(wrong), least, most);
  const Agreement agreement(right, times(), {{"taylor", by_taylor(right)}, {"hbvm", by_hbvm(right)}}, wanted);
  EXPECT_TRUE(agreement.holds()) << text.name;
}

class RoutesAgreement : public ::testing::Test {
 protected:
  PrecisionScope scope_{working};
  Scene text_ = load_scene("simple_pendulum");
  Assembled<Mpfr> scene_ = assemble<Mpfr>(text_);
  RouteRun run_ = by_taylor(scene_);
};

TEST_F(RoutesAgreement, HoldsForAnyNumberOfRunsThatAreTheSame) {
  for (std::size_t n = 1; n <= 4; ++n) {
    const Agreement agreement(scene_, times(), std::vector<NamedRun>(n, {"taylor", run_}), wanted);
    EXPECT_TRUE(agreement.holds());
    EXPECT_NO_THROW(agreement.require());
    // All of them but for what rounding has made of H since the start.
    EXPECT_GE(agreement.digits(), digits10<Mpfr>() - 3);
    const std::vector<ReferenceState> states = agreement.states();
    ASSERT_EQ(states.size(), 2u);
    EXPECT_EQ(states[0].t, "1/2");
    // One run confirms nothing.
    if (n == 1)
      EXPECT_EQ(states[1].agreed, 0);
    else
      EXPECT_GE(states[1].agreed, agreement.digits());
    EXPECT_EQ(states[1].q.size(), 2u);
    EXPECT_EQ(states[1].p.size(), 2u);
    EXPECT_EQ(states[1].lambda.size(), 1u);
    EXPECT_EQ(states[1].momenta.size(), agreement.momentum_names().size());
  }
}

/// Whichever run it is of, and whatever component.
TEST_F(RoutesAgreement, FindsTheNumberThatDiffers) {
  const Mpfr change = literal<Mpfr>("1e-25");
  for (std::size_t which = 0; which < 3; ++which) {
    const auto expect = [&](const char* component, const auto& number) {
      std::vector<NamedRun> runs{{"taylor", run_}, {"hbvm", run_}, {"closed form", run_}};
      Mpfr& x = number(runs[which].run.points[1]);
      x += change;
      const Agreement agreement(scene_, times(), runs, wanted);
      EXPECT_GE(agreement.digits(), 23);
      EXPECT_LE(agreement.digits(), 25);
      const Disagreement found = disagreement_of(agreement);
      EXPECT_EQ(found.t, "2");
      EXPECT_EQ(found.component, component);
      ASSERT_EQ(found.values.size(), 3u);
      for (std::size_t other = 0; other < 3; ++other)
        EXPECT_EQ(found.values[other].number == found.values[which].number, other == which);
    };
    expect("q_1", [](ExactPoint& at) -> Mpfr& { return at.q[0]; });
    expect("q_2", [](ExactPoint& at) -> Mpfr& { return at.q[1]; });
    expect("p_2", [](ExactPoint& at) -> Mpfr& { return at.p[1]; });
    expect("lambda_1", [](ExactPoint& at) -> Mpfr& { return at.lambda[0]; });
  }
}

/// Routes that share a formula of H which does not belong to the forces: what they find is not what the start has.
TEST_F(RoutesAgreement, FindsAnEnergyThatIsNotConserved) {
  Assembled<Mpfr> other = assemble<Mpfr>(text_);
  other.p0 *= 1 + literal<Mpfr>("1e-25");
  const Disagreement found = disagreement_of({other, times(), {{"taylor", run_}, {"hbvm", run_}}, wanted});
  EXPECT_EQ(found.component, "H");
  ASSERT_EQ(found.values.size(), 3u);
  EXPECT_EQ(found.values.back().route, "start");
  expect_words(found.what(), {" at the start"});
}

TEST_F(RoutesAgreement, RefusesWhatIsNoNumber) {
  RouteRun other = run_;
  other.points[0].p[1] = std::numeric_limits<double>::quiet_NaN();
  const auto compare = [&](const RouteRun& a, const RouteRun& b) {
    const Agreement agreement(scene_, times(), {{"taylor", a}, {"hbvm", b}}, wanted);
  };
  EXPECT_THROW(compare(other, run_), IntegrationError);
  EXPECT_THROW(compare(run_, other), IntegrationError);
  other = run_;
  other.points.pop_back();
  EXPECT_THROW(compare(run_, other), IntegrationError);
  other = run_;
  other.points[1].lambda.resize(0);
  EXPECT_THROW(compare(run_, other), IntegrationError);
}

/// What is below the last digit that is printed is rounded there, and not cut off.
TEST_F(RoutesAgreement, RoundsSmallComponents) {
  RouteRun run = run_;
  run.points[0].q << literal<Mpfr>("0.5"), literal<Mpfr>("6e-6");
  run.points[1].q << literal<Mpfr>("0.5"), literal<Mpfr>("-4e-6");
  const std::vector<ReferenceState> states = Agreement(scene_, times(), {{"taylor", run}, {"hbvm", run}}, 4).states();
  const PrecisionScope scope(20);
  EXPECT_EQ(literal<Mpfr>(states[0].q[0]), literal<Mpfr>("0.5"));
  EXPECT_EQ(literal<Mpfr>(states[0].q[1]), literal<Mpfr>("1e-5"));
  EXPECT_EQ(literal<Mpfr>(states[1].q[1]), 0);
}

/// A motion in a plane: across it momenta are 0, and what rounding makes of them is measured by those in the plane.
TEST(RoutesAgreementOfMomenta, MeasuresAZeroByTheOtherComponents) {
  const PrecisionScope scope(working);
  const Assembled<Mpfr> scene =
      assemble<Mpfr>(read_scene("dimension = 3\n" + body("a", "1", "[1, 0, 0]", "[0, 1, 0]") + point("o", "[0, 0, 0]") +
                                    effect("central_gravity", "center = \"o\"\nstrength = 1"),
                                "plane"));
  const RouteRun run = by_taylor(scene);
  RouteRun other = run;
  for (ExactPoint& at : other.points) at.p[2] += literal<Mpfr>("1e-50");
  const Agreement agreement(scene, times(), {{"taylor", run}, {"hbvm", other}}, wanted);
  ASSERT_EQ(agreement.momentum_names().size(), 3u);
  EXPECT_TRUE(agreement.holds());
  EXPECT_GE(agreement.digits(), 48);
}

/// A law of force that is off by 1e-30 in one of the routes alone.
TEST(RoutesAgreementTeeth, FindsAForceLawThatIsOff) {
  const PrecisionScope scope(working);
  for (const auto& [name, key] : {std::pair("kepler", "strength"), {"simple_pendulum", "acceleration"}}) {
    const Scene text = load_scene(name);
    const Assembled<Mpfr> right = assemble<Mpfr>(text);
    Assembled<Mpfr> wrong = assemble<Mpfr>(text);
    ASSERT_EQ(wrong.problem.potential.terms.size(), 1u) << key;
    // The coefficient of the gradient, which the series are made of.
    wrong.problem.potential.terms[0].gradient_coefficients *= 1 + literal<Mpfr>("1e-30");
    expect_found(text, right, wrong, 27, 32);
  }
}

/// A sign of a constraint's second derivative. The value is wrong, too, but not at the start.
TEST(RoutesAgreementTeeth, FindsASignOfASecondDerivative) {
  const PrecisionScope scope(working);
  const Scene text =
      read_scene("dimension = 2\n" + body("bead", "1", "[1, 0]", "[0, 1]") +
                     quadric("bead", "[[1, \"1/8\"], [\"1/8\", 1]]", "[0, \"-1/4\"]", "-1") + field("[0, -1]"),
                 "bead");
  const Assembled<Mpfr> right = assemble<Mpfr>(text);
  Assembled<Mpfr> wrong = assemble<Mpfr>(text);
  auto* const form = std::get_if<Quadric<Mpfr>>(&wrong.problem.constraints.at(0).form);
  ASSERT_NE(form, nullptr);
  form->A(0, 1) = -form->A(0, 1);
  form->A(1, 0) = -form->A(1, 0);
  form->b[1] = -form->b[1];
  expect_found(text, right, wrong, -3, 3);
}

/// One coefficient of the method, any of them, off by 1e-25.
TEST(RoutesAgreementTeeth, FindsACoefficientThatIsOff) {
  const PrecisionScope scope(working);
  const Scene text = load_scene("modified_pendulum");
  const Assembled<Mpfr> scene = assemble<Mpfr>(text);
  const RouteRun taylor = by_taylor(scene);
  StateEvaluator<Mpfr> point(scene.problem);
  constexpr int s = 24;
  const auto by = [&](const Hbvm<Mpfr>& method) {
    HbvmStepper<Mpfr> stepper(scene.problem, method, SolverKind::automatic);
    State<Mpfr> state(scene.q0, scene.p0);
    RouteRun run;
    Mpfr now = 0;
    constexpr int pieces = 8;  // of a half
    for (const Mpfr& t : instants()) {
      for (; now < t; now += Mpfr(1) / (2 * pieces)) stepper.step(state, Mpfr(Mpfr(1) / (2 * pieces)));
      const Vector<Mpfr> p = point.tangential(state.q, state.p);
      run.points.push_back({state.q, p, point.multiplier(state.q, p)});
    }
    return run;
  };
  const Agreement agreement(scene, times(), {{"taylor", taylor}, {"hbvm", by(make_hbvm<Mpfr>(s, s))}}, wanted);
  EXPECT_TRUE(agreement.holds()) << agreement.digits();
  using Part = Perturbation::Part;
  for (const auto& [part, i, j] :
       {std::tuple(Part::node, 3, 0), {Part::weight, 11, 0}, {Part::integral, 7, 1}, {Part::X, 1, 0}}) {
    Hbvm<Mpfr> method = make_hbvm<Mpfr>(s, s);
    perturb(method, Perturbation{.part = part, .hat = false, .i = i, .j = j, .relative = Expression::parse("1e-25")});
    expect_found(text, taylor, by(method), 20, wanted);
  }
}

}  // namespace
}  // namespace hbvm::core
