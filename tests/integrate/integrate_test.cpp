#include "integrate/integrate.hpp"

#include "clock.hpp"
#include "integrate/runs.hpp"
#include "printing.hpp"
#include "problem/state_evaluator.hpp"
#include "solver/error_of.hpp"
#include "solver/falling_stone.hpp"
#include "verification/models.hpp"

namespace hbvm::core {
namespace {

TEST(Integrate, ShowsEveryMeshPointInOrder) {
  for (const char* until : {"1/8", "1", "8", "63/8", "65/8", "128/8", "50"}) {
    SceneRun<double> run(load_scene("simple_pendulum"), 2, 2, "1/8", until);
    Recorder<double> recorder;
    const Integration<double> result = run({&recorder});
    EXPECT_EQ(result.steps, run.grid.steps());
    ASSERT_EQ(recorder.seen.size(), static_cast<std::size_t>(run.grid.steps()) + 1);
    for (long n = 0; n <= run.grid.steps(); ++n) {
      const Snapshot<double>& snapshot = recorder.seen[static_cast<std::size_t>(n)];
      EXPECT_EQ(snapshot.n, n);
      EXPECT_EQ(snapshot.t, run.grid.time(n));
    }
  }
}

TEST(Integrate, ShowsTheStatesThatSingleStepsGive) {
  SceneRun<double> run(load_scene(scene_path("ellipsoid_bead")), 3, 2, "1/20", "5");
  Recorder<double> recorder;
  const Integration<double> result = run({&recorder});

  SceneRun<double> again(load_scene(scene_path("ellipsoid_bead")), 3, 2, "1/20", "5");
  long sweeps = 0;
  for (std::size_t n = 0; n < recorder.seen.size(); ++n) {
    if (n > 0) {
      const StepResult<double> step = again.step();
      sweeps += step.sweeps;
      EXPECT_EQ(recorder.seen[n].lambda, *step.multiplier);
    }
    EXPECT_EQ(recorder.seen[n].q, again.state.q);
    EXPECT_EQ(recorder.seen[n].p, again.state.p);
  }
  EXPECT_EQ(result.sweeps, sweeps);
  EXPECT_EQ(result.end.n, 100);
  EXPECT_EQ(result.end.t, 5);
  EXPECT_EQ(result.end.q, again.state.q);
  EXPECT_EQ(run.state.q, again.state.q);
  EXPECT_EQ(run.state.p_carry, again.state.p_carry);
}

TEST(Integrate, TheFirstMultiplierIsThatOfTheExactState) {
  const PrecisionScope digits(50);
  const DenseModel model = bead_on_curve();
  SceneRun<Mpfr> run(read_scene(model.scene, "curve"), 2, 2, "1/20", "1/20");
  Recorder<Mpfr> recorder;
  run({&recorder});
  const Vector<Mpfr> expected = model.multiplier(run.scene.q0, run.scene.p0);
  EXPECT_LE(max_norm(Vector<Mpfr>(recorder.seen[0].lambda - expected)), 1'000 * epsilon<Mpfr>());
}

TEST(Integrate, CallsObserversInTheOrderGiven) {
  struct Named final : Observer<double> {
    std::string* log;
    char name;
    Named(std::string& all, char own) : log(&all), name(own) {}
    void observe(const Snapshot<double>&) override { *log += name; }
  };
  std::string log;
  Named a(log, 'a'), b(log, 'b');
  SceneRun<double> run(load_scene("simple_pendulum"), 1, 1, "1/8", "1/4");
  run({&a, &b});
  EXPECT_EQ(log, "ababab");
}

TEST(Integrate, AnObserverMayEndIt) {
  struct Stop final : Observer<double> {
    long seen = 0;
    void observe(const Snapshot<double>& snapshot) override {
      ++seen;
      if (snapshot.n == 5) throw IntegrationError("enough");
    }
  } stop;
  SceneRun<double> run(load_scene("simple_pendulum"), 1, 1, "1/8", "100");
  EXPECT_THROW(run({&stop}), IntegrationError);
  EXPECT_EQ(stop.seen, 6);
}

TEST(Integrate, CountsProcessorTimeOfStepsAlone) {
  struct Slow final : Observer<double> {
    double seconds = 0;
    void observe(const Snapshot<double>&) override {
      const double before = thread_seconds();
      while (thread_seconds() < before + 1 / double{1000}) {
      }
      seconds += thread_seconds() - before;
    }
  } slow;
  SceneRun<double> run(load_scene("simple_pendulum"), 1, 1, "1/8", "4");
  const double before = thread_seconds();
  const Integration<double> result = run({&slow});
  const double all = thread_seconds() - before;
  EXPECT_GT(result.cpu_seconds, 0);
  EXPECT_LE(result.cpu_seconds, all - slow.seconds);
}

TEST(FailedIntegration, HasShownAllGoodSteps) {
  for (const auto& [step, least] :
       std::vector<std::pair<const char*, long>>{{"1/10", 2}, {"1/100", 65}, {"1/1000", 1'000}}) {
    SceneRun<double> run(falling_stone("1"), 2, 2, step, "2");
    Recorder<double> recorder;
    const auto error = error_of<StepError>([&] { run({&recorder}); });
    EXPECT_GT(error.step(), least);
    EXPECT_EQ(error.time(), to_text(run.grid.time(error.step() - 1)));
    ASSERT_EQ(recorder.seen.size(), static_cast<std::size_t>(error.step()));  // 0 .. step - 1
    for (std::size_t n = 0; n < recorder.seen.size(); ++n) {
      EXPECT_EQ(recorder.seen[n].n, static_cast<long>(n));
      EXPECT_TRUE(recorder.seen[n].q.allFinite() && recorder.seen[n].p.allFinite());
    }
    EXPECT_EQ(run.state.q, recorder.seen.back().q);
  }
}

TEST(FailedIntegration, OfTheFirstStepHasShownTheStart) {
  SceneRun<double> run(falling_stone("1e-9"), 2, 2, "1", "2");
  Recorder<double> recorder;
  EXPECT_THROW(run({&recorder}), StepError);
  ASSERT_EQ(recorder.seen.size(), 1u);
  EXPECT_EQ(recorder.seen[0].t, 0);
}

template <class S>
class FreeMotion : public InDigits<50> {};
TYPED_TEST_SUITE(FreeMotion, AllScalars, ScalarNames);

TYPED_TEST(FreeMotion, IsAParabola) {
  using S = TypeParam;
  const Scene scene = read_scene(
      "dimension = 2\n[[body]]\nname = \"a\"\nmass = 3\nposition = [1, 2]\nvelocity = [0.5, -1]\n"
      "[[effect]]\nkind = \"uniform_gravity\"\nacceleration = [0.1, -9.81]\n",
      "free");
  SceneRun<S> run(scene, 1, 1, "0.01", "2");
  const Integration<S> result = run({});
  const auto expect = [](const S& value, const char* exact) {
    EXPECT_LE(magnitude(S(value - literal<S>(exact))), 8 * epsilon<S>() * (1 + magnitude(value))) << exact;
  };
  expect(result.end.q[0], "1 + 0.5*2 + 0.1*2");
  expect(result.end.q[1], "2 - 2 - 9.81*2");
  expect(result.end.p[0], "3*(0.5 + 0.1*2)");
  expect(result.end.p[1], "3*(-1 - 9.81*2)");
  EXPECT_EQ(result.end.lambda.size(), 0);
}

}  // namespace
}  // namespace hbvm::core
