#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <type_traits>

#include "scalar/literal.hpp"
#include "scene/assemble.hpp"
#include "scene/scene.hpp"
#include "step/registry.hpp"

namespace hbvm::core {

/// The state after so many steps of size h from the start of a scene.
template <Scalar S>
State<S> after(Stepper<S>& stepper, const Assembled<S>& scene, const std::type_identity_t<S>& h, long steps) {
  State<S> state(scene.q0, scene.p0);
  for (long n = 0; n < steps; ++n) stepper.step(state, h);
  return state;
}

template <Scalar S>
State<S> after(const std::string& method, const Assembled<S>& scene, const std::type_identity_t<S>& h, long steps,
               SolverKind solver = SolverKind::newton) {
  return after(*parse_method(method)->make_stepper(scene.problem, solver), scene, h, steps);
}

/// The order that two errors show, of which the second was made with half the step.
template <Scalar S>
double order_of(const S& coarse, const std::type_identity_t<S>& fine) {
  return std::log2(approximately(S(coarse / fine)));
}

/// How often a part was entered; -1 if there is none of that name.
inline long calls_of(const SolverCounts& counts, const std::string& name) {
  for (const PartCount& part : counts.parts)
    if (part.name == name) return static_cast<long>(part.calls);
  return -1;
}

/// All that a step leaves behind.
template <Scalar S>
std::string bits_of(State<S>& state, Stepper<S>& stepper) {
  Vector<S> multiplier = stepper.multiplier();
  SolverCounts counts = stepper.counts();
  Archive bits;
  bits(state, multiplier);
  for (EffectCount& effect : counts.effects) bits(effect.calls, effect.evaluations);
  for (PartCount& part : counts.parts) bits(part.name, part.calls);
  return bits.text();
}

/// A run is kept and taken up by a new stepper after each of its steps. It has the same bits as one that is not, and
/// takes as many sweeps.
template <Scalar S>
void expect_memory(const std::string& method, const std::string& scene_name, const char* step,
                   SolverKind solver = SolverKind::automatic, long steps = 8) {
  SCOPED_TRACE(method + " on " + scene_name + " by " + std::string(name_of(solver)) + ", step " + step);
  const Assembled<S> scene = assemble<S>(load_scene(scene_name));
  const StepperMaker<S> make = parse_method(method)->prepare(scene.problem, solver);
  const S h = literal<S>(step);
  const auto whole = make();
  State<S> state(scene.q0, scene.p0);
  std::string kept;
  for (long n = 1; n <= steps; ++n) {
    const auto part = make();
    State<S> resumed(scene.q0, scene.p0);
    if (n > 1) {
      Archive reading(kept);
      reading(*part, resumed);
      reading.expect_end();
      Archive again;
      again(*part, resumed);
      EXPECT_EQ(again.text(), kept) << "what is read is not what was written";
    }
    EXPECT_EQ(part->step(resumed, h), whole->step(state, h)) << "step " << n;
    ASSERT_EQ(bits_of(resumed, *part), bits_of(state, *whole)) << "step " << n;
    Archive writing;
    writing(*part, resumed);
    kept = writing.text();
  }
}

}  // namespace hbvm::core
