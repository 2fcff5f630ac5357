#include "step/halving_stepper.hpp"

#include <csignal>

#include "interrupting.hpp"
#include "printing.hpp"
#include "scene/assemble.hpp"
#include "solver/error_of.hpp"
#include "step/hbvm_stepper.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

/// Steps of the motion q' = 1 that fail where a rule says so: on the size and the time, which is q.
class Marching final : public Stepper<double> {
 public:
  using Fails = std::function<bool(double t, double size)>;
  Marching(const Problem<double>& problem, Fails fails, std::vector<double>& tried)
      : problem_(problem), fails_(std::move(fails)), tried_(tried), multiplier_(1) {}

  const Problem<double>& problem() const override { return problem_; }
  StepResult<double> step(State<double>& state, const double& size) override {
    tried_.push_back(size);
    if (fails_(state.q[0], size))
      throw StageFailure(FailureCause::precision_exhausted, "a step of " + std::to_string(size), "1", 10);
    state.q[0] += size;
    multiplier_[0] = size;
    return {1, &multiplier_};
  }
  SolverCounts counts() const override { return {}; }
  void remember(Archive&) override {}

 private:
  const Problem<double>& problem_;
  Fails fails_;
  std::vector<double>& tried_;
  Vector<double> multiplier_;
};

class Halving : public ::testing::Test {
 protected:
  HalvingStepper<double> stepper(Marching::Fails fails) {
    return HalvingStepper<double>(
        [this, fails = std::move(fails)](int) { return std::make_unique<Marching>(scene.problem, fails, tried); });
  }
  const Assembled<double> scene = assemble<double>(load_scene("kepler"));
  State<double> state{Vector<double>::Zero(2), Vector<double>::Zero(2)};
  std::vector<double> tried;
};

TEST_F(Halving, LeavesStepsThatSucceedAlone) {
  HalvingStepper<double> halving = stepper([](double, double) { return false; });
  for (int n = 0; n < 5; ++n) EXPECT_EQ(halving.step(state, 1).sweeps, 1);
  EXPECT_EQ(tried, std::vector<double>(5, 1));
  EXPECT_EQ(halving.log().steps, 0);
  EXPECT_EQ(halving.log().substeps, 0);
}

/// A million parts may take longer than anyone waits; a whole step is finished.
TEST_F(Halving, IsEndedByASignalBetweenParts) {
  HalvingStepper<double> whole = stepper([](double, double) { return false; });
  HalvingStepper<double> in_vain = stepper([](double, double size) { return size > 1.0 / 4; });
  HalvingStepper<double> halving = stepper([](double t, double size) {
    if (t > 0) interruption = SIGTERM;
    return size > 1.0 / 4;
  });
  EXPECT_THROW(halving.step(state, 1), Interrupted);
  EXPECT_EQ(state.q[0], 1.0 / 2);
  tried.clear();
  EXPECT_THROW(in_vain.step(state, 1), Interrupted);
  EXPECT_EQ(tried, std::vector<double>{1});
  EXPECT_EQ(whole.step(state, 1).sweeps, 1);
  interruption = 0;
}

TEST_F(Halving, DividesOneThatFailsAndReturnsToTheWhole) {
  // Between 2 and 3 a step of 1/4 at most.
  HalvingStepper<double> halving =
      stepper([](double t, double size) { return t + size > 2 && t < 3 && size > 1.0 / 4; });
  for (int n = 1; n <= 8; ++n) {
    halving.step(state, 1);
    EXPECT_EQ(state.q[0], n);
  }
  // 1/4 four times; the next step begins with a half.
  EXPECT_EQ(halving.log().steps, 2);
  EXPECT_EQ(halving.log().first_step, 2);
  EXPECT_EQ(halving.log().depth, 2);
  EXPECT_EQ(halving.log().substeps, 6);
  EXPECT_EQ(tried.back(), 1);
}

TEST_F(Halving, SweepsOfFailuresCount) {
  HalvingStepper<double> halving = stepper([](double, double size) { return size > 1.0 / 2; });
  EXPECT_EQ(halving.step(state, 1).sweeps, 12);
}

TEST_F(Halving, TheMultiplierIsThatOfTheLastSubstep) {
  // The second half of the step can be made whole.
  HalvingStepper<double> halving = stepper([](double t, double size) { return t < 1.0 / 2 && size > 1.0 / 8; });
  const double multiplier = (*halving.step(state, 1).multiplier)[0];
  EXPECT_EQ(state.q[0], 1);
  EXPECT_EQ(multiplier, tried.back());
  EXPECT_GT(multiplier, 1.0 / 8);
}

/// Where every whole step fails, one in about a thousand attempts is in vain.
TEST_F(Halving, DoesNotPayTheFailureEveryTime) {
  HalvingStepper<double> halving = stepper([](double, double size) { return size > 1.0 / 4; });
  for (int n = 0; n < 4096; ++n) halving.step(state, 1);
  EXPECT_EQ(state.q[0], 4096);
  EXPECT_EQ(halving.log().steps, 4096);
  EXPECT_EQ(halving.log().substeps, 4 * 4096);
  EXPECT_LE(tried.size(), 4 * 4096 + 40);
}

TEST_F(Halving, ThatFailsAtTheSmallestSizeLeavesTheStateAndTellsTheCause) {
  HalvingStepper<double> halving = stepper([](double t, double size) { return t + size > 1.75; });
  halving.step(state, 1);
  state.q_carry[0] = 3;
  const auto failure = error_of<StageFailure>([&] { halving.step(state, 1); });
  EXPECT_EQ(failure.cause(), FailureCause::precision_exhausted);
  const std::string what = failure.what();
  EXPECT_TRUE(what.starts_with("a step of 1.0")) << what;
  expect_words(what, {"2^-20"});
  EXPECT_GE(failure.sweeps(), 21 * 10);
  EXPECT_EQ(state.q[0], 1);
  EXPECT_EQ(state.q_carry[0], 3);
  EXPECT_EQ(tried.back(), std::ldexp(1, -20));
}

TEST_F(Halving, IsKeptWithAllThatItRemembers) {
  // Around each multiple of 8 smaller steps are needed.
  const auto fails = [](double t, double size) {
    const double away = std::abs(t + size / 2 - 8 * std::round((t + size / 2) / 8));
    return away < 2 && size > away / 4 + 1.0 / 64;
  };
  HalvingStepper<double> whole = stepper(fails);
  std::optional<HalvingStepper<double>> part;
  State<double> resumed = state;
  Archive kept;
  for (int n = 0; n < 40; ++n) {
    part.emplace([&](int) { return std::make_unique<Marching>(scene.problem, fails, tried); });
    if (n > 0) {
      Archive reading(kept.text());
      reading(*part, resumed);
      reading.expect_end();
    }
    tried.clear();
    const long sweeps = whole.step(state, 1).sweeps;
    const std::vector<double> expected = tried;
    tried.clear();
    EXPECT_EQ(part->step(resumed, 1).sweeps, sweeps);
    EXPECT_EQ(tried, expected) << n;
    EXPECT_EQ(resumed.q[0], state.q[0]);
    kept = {};
    kept(*part, resumed);
  }
  EXPECT_GT(whole.log().depth, 4);
  EXPECT_EQ(part->log().steps, whole.log().steps);
  EXPECT_EQ(part->log().substeps, whole.log().substeps);
  EXPECT_EQ(part->log().depth, whole.log().depth);
  EXPECT_EQ(part->log().first_step, whole.log().first_step);
}

template <Scalar S>
class NeverMade final : public Stepper<S> {
 public:
  explicit NeverMade(const Problem<S>& problem) : problem_(problem) {}
  const Problem<S>& problem() const override { return problem_; }
  StepResult<S> step(State<S>&, const S&) override {
    throw StageFailure(FailureCause::stage_equations_diverge, "too long", "1", 1);
  }
  SolverCounts counts() const override { return {}; }
  void remember(Archive&) override {}

 private:
  const Problem<S>& problem_;
};

template <class S>
class HalvingOfAPendulum : public InDigits<50> {};
TYPED_TEST_SUITE(HalvingOfAPendulum, AllScalars, ScalarNames);

/// The substeps are steps of the method: divided once throughout, they are those of half the size, bit for bit.
TYPED_TEST(HalvingOfAPendulum, IsTheMethodWithSmallerSteps) {
  using S = TypeParam;
  const Assembled<S> scene = assemble<S>(load_scene("simple_pendulum"));
  const Hbvm<S> method = make_hbvm<S>(2, 2);
  const S h = S(1) / 8;
  HalvingStepper<S> halving([&](int depth) -> std::unique_ptr<Stepper<S>> {
    if (depth == 0) return std::make_unique<NeverMade<S>>(scene.problem);
    return std::make_unique<HbvmStepper<S>>(scene.problem, method, SolverKind::fixed_point);
  });
  State<S> state(scene.q0, scene.p0), expected = state;
  HbvmStepper<S> half(scene.problem, method, SolverKind::fixed_point);
  for (int n = 0; n < 4; ++n) {
    const StepResult<S> divided = halving.step(state, h);
    StepResult<S> last;
    for (int i = 0; i < 2; ++i) last = half.step(expected, S(h / 2));
    EXPECT_EQ(state.q, expected.q);
    EXPECT_EQ(state.p, expected.p);
    EXPECT_EQ(state.p_carry, expected.p_carry);
    EXPECT_EQ(*divided.multiplier, *last.multiplier);
  }
}

}  // namespace
}  // namespace hbvm::core
