#include "step/composition.hpp"

#include "printing.hpp"
#include "step/rattle.hpp"
#include "step/stepping.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

template <class S>
class Compositions : public InDigits<60> {};
TYPED_TEST_SUITE(Compositions, AllScalars, ScalarNames);

/// Those of order 4 sum to 1 and their third powers to 0; symmetric in every order.
TYPED_TEST(Compositions, StepsFulfilTheirConditions) {
  using S = TypeParam;
  EXPECT_EQ(composition_steps<S>(2), Vector<S>::Constant(1, S(1)));
  for (const int order : {4, 6, 8}) {
    const Vector<S> steps = composition_steps<S>(order);
    ASSERT_EQ(steps.size(), std::lround(std::pow(5, order / 2 - 1)));
    S sum = 0, cubes = 0, fifths = 0;
    for (Index i = 0; i < steps.size(); ++i) {
      EXPECT_EQ(steps[i], steps[steps.size() - 1 - i]);
      sum += steps[i];
      cubes += steps[i] * steps[i] * steps[i];
      fifths += steps[i] * steps[i] * steps[i] * steps[i] * steps[i];
    }
    const S tolerance = S(steps.size()) * epsilon<S>();
    EXPECT_LE(magnitude(S(sum - 1)), tolerance);
    EXPECT_LE(magnitude(cubes), tolerance);
    if (order >= 6) {
      EXPECT_LE(magnitude(fifths), tolerance);
    }
  }
}

TEST(CompositionSteps, HaveAnEvenOrder) {
  for (const int order : {-2, 0, 1, 3, 13, 14}) EXPECT_THROW(composition_steps<double>(order), InputError);
}

/// The error at a fixed time falls by 2^P.
TEST(Composition, OfRattleHasItsOrder) {
  const PrecisionScope digits(60);
  const Assembled<Mpfr> scene = assemble<Mpfr>(load_scene("double_pendulum"));
  const State<Mpfr> expected = after("hbvm:12,12", scene, Mpfr(1) / 32, 8);
  for (const auto& [method, order] : {std::pair("compose:rattle,4", 4), {"compose:rattle,6", 6}}) {
    const auto error = [&, method = method](long steps) {
      return distance(after(method, scene, Mpfr(1) / (4 * steps), steps).q, expected.q);
    };
    EXPECT_NEAR(order_of(error(8), error(16)), order, 0.25) << method;
  }
}

/// A part that cannot be made leaves the state, and the failure says which it was.
TEST(Composition, ThatFailsLeavesTheState) {
  const Assembled<double> scene = assemble<double>(load_scene("double_pendulum"));
  CompositionStepper<double> stepper(std::make_unique<Rattle<double>>(scene.problem), composition_steps<double>(4));
  State<double> state(scene.q0, scene.p0);
  expect_words(message_of<StageFailure>([&] { stepper.step(state, 100); }), {"of 5"});
  EXPECT_EQ(state.q, scene.q0);
  EXPECT_EQ(state.p, scene.p0);
}

/// A stepper whose third step fails.
class FailsAtTheThird final : public ForwardingStepper<double> {
 public:
  using ForwardingStepper<double>::ForwardingStepper;
  StepResult<double> step(State<double>& state, const double& h) override {
    if (++steps_ == 3) throw StageFailure(FailureCause::precision_exhausted, "it is to fail", "1", 7);
    return inner().step(state, h);
  }

 private:
  int steps_ = 0;
};

/// The parts made before the one that fails are taken back.
TEST(Composition, ThatFailsHalfwayTakesItsPartsBack) {
  const Assembled<double> scene = assemble<double>(load_scene("double_pendulum"));
  CompositionStepper<double> stepper(std::make_unique<FailsAtTheThird>(std::make_unique<Rattle<double>>(scene.problem)),
                                     composition_steps<double>(4)),
      other(std::make_unique<Rattle<double>>(scene.problem), composition_steps<double>(4));
  State<double> state(scene.q0, scene.p0), expected = state;
  const double h = 1. / 8;
  expect_words(message_of<StageFailure>([&] { stepper.step(state, h); }), {"part 3 of 5", "it is to fail"});
  EXPECT_EQ(state.q, scene.q0);
  EXPECT_EQ(state.p, scene.p0);
  EXPECT_EQ(max_norm(state.q_carry), 0);
  stepper.step(state, h);
  other.step(expected, h);
  EXPECT_LE(distance(state.q, expected.q), 16 * epsilon<double>());
}

}  // namespace
}  // namespace hbvm::core
