#include "step/reduced_stepper.hpp"

#include <gtest/gtest.h>

#include "printing.hpp"
#include "scene/assemble.hpp"
#include "solver/error_of.hpp"

namespace hbvm::core {
namespace {

template <class S>
class Reduced : public InDigits<40> {};
TYPED_TEST_SUITE(Reduced, AllScalars, ScalarNames);

/// The forces of a Point, and its multiplier.
TYPED_TEST(Reduced, EquationsAreThoseOfAPoint) {
  using S = TypeParam;
  for (const char* const name : {"double_pendulum", "heavy_top", "kepler", "tethered_satellites"}) {
    const Assembled<S> scene = assemble<S>(load_scene(name));
    ReducedEquations<S> equations(scene.problem);
    StateEvaluator<S> point(scene.problem);
    equations.evaluate(scene.q0, scene.p0);
    const auto& forces = point.forces(scene.q0, scene.p0);
    EXPECT_LE(distance(equations.force(), Vector<S>(forces.applied + forces.constraint)),
              16 * epsilon<S>() * (max_norm(forces.applied) + max_norm(forces.constraint)))
        << name;
    EXPECT_EQ(scene.problem.mass.momentum(equations.velocity()).size(), scene.problem.m());
    if (scene.problem.nu() > 0) {
      EXPECT_EQ(equations.multiplier(), point.multiplier(scene.q0, scene.p0)) << name;
    }
  }
}

/// Euler's method, and one that fails halfway.
template <Scalar S>
class Euler final : public ReducedStepper<S> {
 public:
  using ReducedStepper<S>::ReducedStepper;
  bool fails = false;

 protected:
  long advance(const S& h) override {
    for (Index j = 0; j < this->dq_.size(); ++j) {
      this->dq_[j] = h * this->start_velocity()[j];
      this->dp_[j] = h * this->start_force()[j];
    }
    if (fails) throw StageFailure(FailureCause::precision_exhausted, "it is to fail", "1", 7);
    return 3;
  }
};

TYPED_TEST(Reduced, StepsAddChangesAndEvaluateOnceEach) {
  using S = TypeParam;
  const Assembled<S> scene = assemble<S>(load_scene("double_pendulum"));
  Euler<S> euler(scene.problem);
  State<S> state(scene.q0, scene.p0);
  StateEvaluator<S> point(scene.problem);
  const S h = S(1) / 64;
  for (int n = 0; n < 5; ++n) {
    const auto forces = point.forces(state.q, state.p);
    const Vector<S> q = state.q, p = state.p;
    Vector<S> v(q.size());
    scene.problem.mass.velocity(lanes(p), lanes(v));
    const StepResult<S> step = euler.step(state, h);
    EXPECT_EQ(step.sweeps, 3);
    EXPECT_LE(distance(state.q, Vector<S>(q + h * v)), 8 * epsilon<S>());
    EXPECT_LE(distance(state.p, Vector<S>(p + h * (forces.applied + forces.constraint))), 64 * epsilon<S>());
    EXPECT_EQ(*step.multiplier, point.multiplier(state.q, state.p));
  }
  // One before the first step, and one at the end of each.
  const auto counts = euler.counts();
  for (const PartCount& part : counts.parts) EXPECT_EQ(part.calls, 6U) << part.name;
}

TYPED_TEST(Reduced, AStepThatFailsLeavesTheState) {
  using S = TypeParam;
  const Assembled<S> scene = assemble<S>(load_scene("double_pendulum"));
  Euler<S> euler(scene.problem), other(scene.problem);
  State<S> state(scene.q0, scene.p0), expected = state;
  euler.fails = true;
  const auto failure = error_of<StageFailure>([&] { euler.step(state, S(S(1) / 8)); });
  EXPECT_EQ(failure.cause(), FailureCause::precision_exhausted);
  EXPECT_EQ(failure.sweeps(), 7);
  EXPECT_EQ(state.q, scene.q0);
  EXPECT_EQ(state.p, scene.p0);
  euler.fails = false;
  euler.step(state, S(S(1) / 8));
  other.step(expected, S(S(1) / 8));
  EXPECT_EQ(state.q, expected.q);
  EXPECT_EQ(state.p, expected.p);
}

/// Between steps a scene can change p alone: by an impulse, or for the motion backwards.
TYPED_TEST(Reduced, MeetsOtherMomentaAtTheSamePositions) {
  using S = TypeParam;
  const Assembled<S> scene = assemble<S>(load_scene("double_pendulum"));
  Euler<S> euler(scene.problem), fresh(scene.problem);
  State<S> state(scene.q0, scene.p0);
  euler.step(state, S(S(1) / 64));
  State<S> turned(state.q, Vector<S>(-2 * state.p)), expected = turned;
  euler.step(turned, S(S(1) / 64));
  fresh.step(expected, S(S(1) / 64));
  EXPECT_EQ(turned.q, expected.q);
  EXPECT_EQ(turned.p, expected.p);
  EXPECT_NE(turned.q, state.q);
}

TEST(ReducedEquation, SaysWhereGradientsAreDependentAndForcesAreNone) {
  const Assembled<double> pendulum = assemble<double>(load_scene("double_pendulum")),
                          kepler = assemble<double>(load_scene("kepler"));
  ReducedEquations<double> folded(pendulum.problem), fallen(kepler.problem);
  const Vector<double> origin = Vector<double>::Zero(4), centre = Vector<double>::Zero(2);
  EXPECT_EQ(error_of<StageFailure>([&] { folded.evaluate(origin, origin); }).cause(),
            FailureCause::near_singular_constraints);
  EXPECT_THROW(fallen.evaluate(centre, centre), StageFailure);
}

}  // namespace
}  // namespace hbvm::core
