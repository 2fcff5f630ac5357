#include "step/projected_stepper.hpp"

#include "printing.hpp"
#include "problem/state_evaluator.hpp"
#include "solver/error_of.hpp"
#include "step/stepping.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

template <class S>
class ProjectedSteps : public InDigits<50> {};
TYPED_TEST_SUITE(ProjectedSteps, AllScalars, ScalarNames);

/// A step is that of HBVM from the projected state, so that one step ends with the output state of HBVM.
TYPED_TEST(ProjectedSteps, BeginAsHbvmEnds) {
  using S = TypeParam;
  SceneSteps<S> plain(load_scene("modified_pendulum"), "hbvm:4,2"),
      projected(load_scene("modified_pendulum"), "projected_hbvm:4,2");
  const StepResult<S> of_plain = plain.step(S(1) / 16), of_projected = projected.step(S(1) / 16);
  const State<S>&raw = plain.state, &state = projected.state;
  StateEvaluator<S> point(plain.scene.problem);
  EXPECT_EQ(state.q, raw.q);
  EXPECT_LE(distance(state.p, point.tangential(raw.q, raw.p)), 16 * epsilon<S>());
  EXPECT_GT(distance(state.p, raw.p), 1'000 * epsilon<S>());
  EXPECT_EQ(*of_projected.multiplier, *of_plain.multiplier);
}

/// The projection takes energy in every step, O(h^(2s+1)) of it over an interval.
TEST(ProjectedHbvm, LosesEnergyAtItsRate) {
  const PrecisionScope digits(50);
  const Assembled<Mpfr> scene = assemble<Mpfr>(load_scene("modified_pendulum"));
  StateEvaluator<Mpfr> point(scene.problem);
  const Mpfr H0 = point.energy(scene.q0, scene.p0);
  const auto lost = [&](const std::string& method, long steps) {
    const State<Mpfr> end = after(method, scene, Mpfr(1) / (2 * steps), steps);
    return Mpfr(H0 - point.energy(end.q, end.p));
  };
  for (const int s : {1, 2, 3}) {
    const std::string method = "projected_hbvm:" + std::to_string(s + 4) + "," + std::to_string(s);
    EXPECT_GT(lost(method, 16), 0) << method;
    EXPECT_NEAR(order_of(lost(method, 32), lost(method, 64)), 2 * s + 1, 0.2) << method;
  }
}

/// H stays that of the start, and what rounding does to it does not add up; nodes need not be enough.
TYPED_TEST(ProjectedSteps, RestoreTheEnergy) {
  using S = TypeParam;
  for (const char* const method : {"restored_hbvm:2,2", "restored_hbvm:4,3"}) {
    SceneSteps<S> pendulum(load_scene("modified_pendulum"), method);
    const State<S>& state = pendulum.state;
    StateEvaluator<S> point(pendulum.scene.problem);
    const S H0 = point.energy(state.q, state.p), size = point.energy_size(state.q, state.p);
    for (int n = 0; n < 500; ++n) {
      pendulum.step(S(1) / 16);
      ASSERT_LE(magnitude(S(point.energy(state.q, state.p) - H0)), 16 * size * epsilon<S>()) << method << ' ' << n;
    }
  }
}

TEST(ProjectedHbvm, HasOrder2s) {
  const PrecisionScope digits(50);
  const Assembled<Mpfr> scene = assemble<Mpfr>(load_scene("double_pendulum"));
  const auto end = [&](const std::string& method, long steps) {
    return after(method, scene, Mpfr(1) / (4 * steps), steps);
  };
  StateEvaluator<Mpfr> point(scene.problem);
  const State<Mpfr> exact = end("hbvm:12,12", 8);
  const Vector<Mpfr> p = point.tangential(exact.q, exact.p);
  for (const char* const family : {"projected_hbvm", "restored_hbvm"})
    for (const int s : {1, 2, 3}) {
      const std::string method = std::string(family) + ":" + std::to_string(s) + "," + std::to_string(s);
      const State<Mpfr> coarse = end(method, 16), fine = end(method, 32);
      EXPECT_NEAR(order_of(distance(coarse.q, exact.q), distance(fine.q, exact.q)), 2 * s, 0.2) << method;
      EXPECT_NEAR(order_of(distance(coarse.p, p), distance(fine.p, p)), 2 * s, 0.2) << method;
    }
}

/// Whoever put a state there, its energy is the one that is kept from then on.
TEST(RestoredHbvm, TakesAStateThatItDidNotMake) {
  const Assembled<double> scene = assemble<double>(load_scene("modified_pendulum"));
  const auto make = parse_method("restored_hbvm:4,2")->prepare(scene.problem, SolverKind::automatic);
  const auto used = make(), fresh = make();
  State<double> state(scene.q0, scene.p0), slow(scene.q0, Vector<double>(scene.p0 / 2)), again = slow;
  used->step(state, 0.05);
  used->step(slow, 0.05);
  fresh->step(again, 0.05);
  StateEvaluator<double> point(scene.problem);
  EXPECT_NEAR(point.energy(slow.q, slow.p), point.energy(again.q, again.p), 1e-14);
}

/// Moves and comes to rest: no scaling of p restores H.
class Stop final : public Stepper<double> {
 public:
  explicit Stop(const Problem<double>& problem) : problem_(problem) {}
  const Problem<double>& problem() const override { return problem_; }
  StepResult<double> step(State<double>& state, const double& h) override {
    state.q[0] += h;
    state.p.setZero();
    return {5};
  }
  SolverCounts counts() const override {
    return {std::vector<EffectCount>(problem_.potential.terms.size()), {{"nothing"}}};
  }
  void remember(Archive&) override {}

 private:
  const Problem<double>& problem_;
};

TEST(ProjectedStep, ThatCannotRestoreHSaysSo) {
  const Assembled<double> scene = assemble<double>(load_scene("kepler"));
  ProjectedStepper<double> stepper(std::make_unique<Stop>(scene.problem), OnEnergy::restore);
  State<double> state(scene.q0, scene.p0);
  const auto failure = error_of<StageFailure>([&] { stepper.step(state, 0.1); });
  expect_words(failure.what(), {"H cannot be restored"});
  EXPECT_EQ(failure.sweeps(), 5);
  EXPECT_EQ(state.q, scene.q0);
  EXPECT_EQ(state.p, scene.p0);
}

}  // namespace
}  // namespace hbvm::core
