#include "step/projected_stepper.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "printing.hpp"
#include "problem/point.hpp"
#include "scene/assemble.hpp"
#include "step/registry.hpp"

namespace hbvm::core {
namespace {

template <class S>
class ProjectedSteps : public ::testing::Test {
 protected:
  PrecisionScope digits{50};
};
TYPED_TEST_SUITE(ProjectedSteps, AllScalars, ScalarNames);

constexpr const char* both[] = {"projected_hbvm:4,2", "restored_hbvm:4,2"};

TYPED_TEST(ProjectedSteps, EndOnTheConstraintsAndInTheirTangentSpace) {
  using S = TypeParam;
  for (const char* const method : both)
    for (const char* const name : {"tethered_satellites", "modified_pendulum", "heavy_top"}) {
      const Assembled<S> scene = assemble<S>(load_scene(name));
      const auto stepper = parse_method(method)->make_stepper(scene.problem, SolverKind::automatic);
      State<S> state(scene.q0, scene.p0);
      Point<S> point(scene.problem);
      for (int n = 0; n < 20; ++n) {
        stepper->step(state, S(S(1) / 16));
        EXPECT_LE(max_norm(point.constraints(state.q)), 32 * epsilon<S>() * point.constraint_size(state.q)) << name;
        EXPECT_LE(max_norm(point.hidden_constraints(state.q, state.p)), 256 * epsilon<S>()) << name;
      }
    }
}

/// A step is that of HBVM from the projected state, so that one step ends with the output state of HBVM.
TYPED_TEST(ProjectedSteps, BeginAsHbvmEnds) {
  using S = TypeParam;
  const Assembled<S> scene = assemble<S>(load_scene("modified_pendulum"));
  const auto plain = parse_method("hbvm:4,2")->make_stepper(scene.problem, SolverKind::automatic),
             projected = parse_method(both[0])->make_stepper(scene.problem, SolverKind::automatic);
  State<S> raw(scene.q0, scene.p0), state = raw;
  plain->step(raw, S(S(1) / 16));
  projected->step(state, S(S(1) / 16));
  Point<S> point(scene.problem);
  EXPECT_EQ(state.q, raw.q);
  EXPECT_LE(distance(state.p, point.tangential(raw.q, raw.p)), 16 * epsilon<S>());
  EXPECT_GT(distance(state.p, raw.p), 1'000 * epsilon<S>());
  EXPECT_EQ(projected->multiplier(), plain->multiplier());
}

/// The projection takes energy in every step, O(h^(2s+1)) of it over an interval.
TEST(ProjectedHbvm, LosesEnergyAtItsRate) {
  const PrecisionScope digits(50);
  const Assembled<Mpfr> scene = assemble<Mpfr>(load_scene("modified_pendulum"));
  Point<Mpfr> point(scene.problem);
  const Mpfr H0 = point.energy(scene.q0, scene.p0);
  const auto lost = [&](const char* method, long steps) {
    const auto stepper = parse_method(method)->make_stepper(scene.problem, SolverKind::newton);
    State<Mpfr> state(scene.q0, scene.p0);
    for (long n = 0; n < steps; ++n) stepper->step(state, Mpfr(Mpfr(1) / (2 * steps)));
    return Mpfr(H0 - point.energy(state.q, state.p));
  };
  for (const int s : {1, 2, 3}) {
    const std::string method = "projected_hbvm:" + std::to_string(s + 4) + "," + std::to_string(s);
    EXPECT_GT(lost(method.c_str(), 16), 0) << method;
    EXPECT_NEAR(std::log2(approximately(Mpfr(lost(method.c_str(), 32) / lost(method.c_str(), 64)))), 2 * s + 1, 0.2)
        << method;
  }
}

/// H stays that of the start, and what rounding does to it does not add up; nodes need not be enough.
TYPED_TEST(ProjectedSteps, RestoreTheEnergy) {
  using S = TypeParam;
  for (const char* const method : {"restored_hbvm:2,2", "restored_hbvm:4,3"}) {
    const Assembled<S> scene = assemble<S>(load_scene("modified_pendulum"));
    const auto stepper = parse_method(method)->make_stepper(scene.problem, SolverKind::automatic);
    State<S> state(scene.q0, scene.p0);
    Point<S> point(scene.problem);
    const S H0 = point.energy(state.q, state.p), size = point.energy_size(state.q, state.p);
    for (int n = 0; n < 500; ++n) {
      stepper->step(state, S(S(1) / 16));
      ASSERT_LE(magnitude(S(point.energy(state.q, state.p) - H0)), 16 * size * epsilon<S>()) << method << ' ' << n;
    }
  }
}

TEST(ProjectedHbvm, HasOrder2s) {
  const PrecisionScope digits(50);
  const Assembled<Mpfr> scene = assemble<Mpfr>(load_scene("double_pendulum"));
  const auto end = [&](const std::string& method, long steps) {
    const auto stepper = parse_method(method)->make_stepper(scene.problem, SolverKind::newton);
    State<Mpfr> state(scene.q0, scene.p0);
    for (long n = 0; n < steps; ++n) stepper->step(state, Mpfr(Mpfr(1) / (4 * steps)));
    return state;
  };
  Point<Mpfr> point(scene.problem);
  const State<Mpfr> exact = end("hbvm:12,12", 8);
  const Vector<Mpfr> p = point.tangential(exact.q, exact.p);
  for (const char* const family : {"projected_hbvm", "restored_hbvm"})
    for (const int s : {1, 2, 3}) {
      const std::string method = std::string(family) + ":" + std::to_string(s) + "," + std::to_string(s);
      const State<Mpfr> coarse = end(method, 16), fine = end(method, 32);
      EXPECT_NEAR(std::log2(approximately(Mpfr(distance(coarse.q, exact.q) / distance(fine.q, exact.q)))), 2 * s, 0.2)
          << method;
      EXPECT_NEAR(std::log2(approximately(Mpfr(distance(coarse.p, p) / distance(fine.p, p)))), 2 * s, 0.2) << method;
    }
}

TYPED_TEST(ProjectedSteps, GoOnFromWhatTheyRemember) {
  using S = TypeParam;
  const Assembled<S> scene = assemble<S>(load_scene("tethered_satellites"));
  for (const char* const method : both) {
    const auto make = parse_method(method)->prepare(scene.problem, SolverKind::automatic);
    const auto whole = make(), part = make();
    const S h = S(1) / 32;
    State<S> state(scene.q0, scene.p0);
    for (int n = 0; n < 5; ++n) whole->step(state, h);
    Archive writing;
    writing(*whole, state);
    Archive reading(writing.text());
    State<S> resumed = state;
    reading(*part, resumed);
    reading.expect_end();
    for (int n = 0; n < 3; ++n) EXPECT_EQ(part->step(resumed, h), whole->step(state, h));
    EXPECT_EQ(resumed.q, state.q);
    EXPECT_EQ(resumed.p, state.p);
    EXPECT_EQ(resumed.p_carry, state.p_carry);
    const SolverCounts counts = whole->counts(), later = part->counts();
    EXPECT_EQ(counts.effects[0].evaluations, later.effects[0].evaluations);
    ASSERT_EQ(counts.parts.size(), later.parts.size());
    for (std::size_t i = 0; i < counts.parts.size(); ++i) {
      EXPECT_EQ(counts.parts[i].name, later.parts[i].name);
      EXPECT_EQ(counts.parts[i].calls, later.parts[i].calls) << counts.parts[i].name;
    }
  }
}

/// Whoever put a state there, its energy is the one that is kept from then on.
TEST(RestoredHbvm, TakesAStateThatItDidNotMake) {
  const Assembled<double> scene = assemble<double>(load_scene("modified_pendulum"));
  const auto make = parse_method(both[1])->prepare(scene.problem, SolverKind::automatic);
  const auto used = make(), fresh = make();
  State<double> state(scene.q0, scene.p0), slow(scene.q0, Vector<double>(scene.p0 / 2)), again = slow;
  used->step(state, 0.05);
  used->step(slow, 0.05);
  fresh->step(again, 0.05);
  Point<double> point(scene.problem);
  EXPECT_NEAR(point.energy(slow.q, slow.p), point.energy(again.q, again.p), 1e-14);
}

TEST(ProjectedHbvm, RefusesAndFailsWithItsReason) {
  const auto refusal = [](const std::string& text) -> std::string {
    try {
      parse_method(text);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  for (const std::string family : {"projected_hbvm", "restored_hbvm"}) {
    for (const char* const arguments : {"", ":", ":2", ":2,3", ":0,0", ":2,2x", ":auto,2"})
      EXPECT_NE(refusal(family + arguments).find(family), std::string::npos) << family << arguments;
  }
  const Assembled<double> scene = assemble<double>(load_scene("kepler"));
  for (const char* const method : both) {
    const auto stepper = parse_method(method)->make_stepper(scene.problem, SolverKind::automatic);
    State<double> centre(Vector<double>::Zero(2), Vector<double>::Zero(2));
    EXPECT_THROW(stepper->step(centre, 0.1), StageFailure);
    EXPECT_EQ(centre.q, (Vector<double>(Vector<double>::Zero(2))));
  }
}

/// Moves and comes to rest: no scaling of p restores H.
class Stop final : public Stepper<double> {
 public:
  explicit Stop(const Problem<double>& problem) : problem_(problem), multiplier_(problem.nu()) {}
  const Problem<double>& problem() const override { return problem_; }
  long step(State<double>& state, const double& h) override {
    state.q[0] += h;
    state.p.setZero();
    return 5;
  }
  const Vector<double>& multiplier() const override { return multiplier_; }
  SolverCounts counts() const override {
    return {std::vector<EffectCount>(problem_.potential.terms.size()), {{"nothing"}}};
  }
  void measure_time() override {}
  void remember(Archive&) override {}

 private:
  const Problem<double>& problem_;
  Vector<double> multiplier_;
};

TEST(ProjectedStep, ThatCannotRestoreHSaysSo) {
  const Assembled<double> scene = assemble<double>(load_scene("kepler"));
  ProjectedStepper<double> stepper(std::make_unique<Stop>(scene.problem), OnEnergy::restore);
  State<double> state(scene.q0, scene.p0);
  try {
    stepper.step(state, 0.1);
    ADD_FAILURE() << "H was restored with p = 0";
  } catch (const StageFailure& failure) {
    EXPECT_NE(std::string(failure.what()).find("H cannot be restored"), std::string::npos) << failure.what();
    EXPECT_EQ(failure.sweeps(), 5);
  }
  EXPECT_EQ(state.q, scene.q0);
  EXPECT_EQ(state.p, scene.p0);
}

}  // namespace
}  // namespace hbvm::core
