#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "scalar/literal.hpp"
#include "scene/assemble.hpp"
#include "scene/scene.hpp"
#include "step/registry.hpp"

namespace hbvm::core {

/// The state after so many steps of size h from the start of a scene; `last` is what the last one left.
template <Scalar S>
State<S> after(Stepper<S>& stepper, const Assembled<S>& scene, const std::type_identity_t<S>& h, long steps,
               StepResult<S>* last = nullptr) {
  State<S> state(scene.q0, scene.p0);
  for (long n = 0; n < steps; ++n) {
    const StepResult<S> made = stepper.step(state, h);
    if (last) *last = made;
  }
  return state;
}

template <Scalar S>
State<S> after(const std::string& method, const Assembled<S>& scene, const std::type_identity_t<S>& h, long steps,
               SolverKind solver = SolverKind::newton) {
  return after(*parse_method(method)->make_stepper(scene.problem, solver), scene, h, steps);
}

/// The same, and the multiplier of the end.
template <Scalar S>
std::pair<State<S>, Vector<S>> end_of(const std::string& method, const Assembled<S>& scene,
                                      const std::type_identity_t<S>& h, long steps) {
  const auto stepper = parse_method(method)->make_stepper(scene.problem, SolverKind::newton);
  StepResult<S> last;
  const State<S> state = after(*stepper, scene, h, steps, &last);
  return {state, *last.multiplier};
}

/// A scene on its way, by the steps of one stepper.
template <Scalar S>
struct SceneSteps {
  Assembled<S> scene;
  std::unique_ptr<Stepper<S>> stepper;
  State<S> state;

  SceneSteps(const Scene& text, const std::string& method, SolverKind solver = SolverKind::automatic)
      : scene(assemble<S>(text)),
        stepper(parse_method(method)->make_stepper(scene.problem, solver)),
        state(scene.q0, scene.p0) {}
  SceneSteps(const SceneSteps&) = delete;

  StepResult<S> step(const std::type_identity_t<S>& h) { return stepper->step(state, h); }
  void expect_start() const {
    EXPECT_EQ(state.q, scene.q0);
    EXPECT_EQ(state.p, scene.p0);
  }
};

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

/// The state and the multiplier that a step leaves behind.
template <Scalar S>
std::string bits_of(State<S>& state, const StepResult<S>& step) {
  Vector<S> multiplier = *step.multiplier;
  Archive bits;
  bits(state, multiplier);
  return bits.text();
}

/// How often each effect was evaluated and each part entered.
inline std::vector<std::pair<std::string, std::uint64_t>> all_calls(const SolverCounts& counts) {
  std::vector<std::pair<std::string, std::uint64_t>> result;
  for (const EffectCount& effect : counts.effects) result.emplace_back("an effect", effect.evaluations);
  for (const PartCount& part : counts.parts) result.emplace_back(part.name, part.calls);
  return result;
}

/// A run that was taken up again has the counts of one that was not. A stepper that keeps what its last step ended with
/// computes that once more each time.
inline void expect_counts(const SolverCounts& resumed, const SolverCounts& whole, std::uint64_t times_taken_up) {
  const auto again = all_calls(resumed), once = all_calls(whole);
  ASSERT_EQ(again.size(), once.size());
  for (std::size_t i = 0; i < again.size(); ++i) {
    EXPECT_EQ(again[i].first, once[i].first);
    EXPECT_GE(again[i].second, once[i].second) << again[i].first;
    EXPECT_LE(again[i].second, once[i].second + times_taken_up) << again[i].first;
  }
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
      Archive copy;
      copy(*part, resumed);
      EXPECT_EQ(copy.text(), kept) << "what is read is not what was written";
    }
    const StepResult<S> again = part->step(resumed, h), once = whole->step(state, h);
    EXPECT_EQ(again.sweeps, once.sweeps) << "step " << n;
    ASSERT_EQ(bits_of(resumed, again), bits_of(state, once)) << "step " << n;
    expect_counts(part->counts(), whole->counts(), static_cast<std::uint64_t>(n - 1));
    Archive writing;
    writing(*part, resumed);
    kept = writing.text();
  }
}

}  // namespace hbvm::core
