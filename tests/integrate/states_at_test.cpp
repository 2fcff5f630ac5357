#include "integrate/states_at.hpp"

#include "hbvm/error.hpp"
#include "integrate/runs.hpp"
#include "printing.hpp"
#include "step/hbvm_method.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

template <class S>
class StatesAtOf : public InDigits<40> {};
TYPED_TEST_SUITE(StatesAtOf, AllScalars, ScalarNames);

/// Each comes once, in order, from the nearest mesh point; those of mesh points are theirs.
TYPED_TEST(StatesAtOf, AreFoundInOrder) {
  using S = TypeParam;
  SceneRun<S> run(load_scene("simple_pendulum"), 4, 2, "1/8", "1", SolverKind::newton);
  BetweenSteps<S> between(hbvm_of({4, 2})->make_stepper<S>(run.scene.problem, SolverKind::automatic));
  const std::vector<S> times{S(0), S(1) / 100, S(1) / 16, S(1) / 8, S(1) / 2 + S(1) / 100, S(99) / 100, S(1)};
  StatesAt<S> at(between, times, Direction::forward);
  Recorder<S> recorder;
  run({&at, &recorder});
  at.finish();
  ASSERT_EQ(at.states().size(), times.size());
  for (std::size_t i = 0; i < times.size(); ++i) EXPECT_EQ(at.states()[i].t, times[i]);
  EXPECT_EQ(at.states()[0].q, recorder.seen[0].q);
  EXPECT_EQ(at.states()[3].q, recorder.seen[1].q);
  EXPECT_EQ(at.states()[6].q, recorder.seen[8].q);
  // What solved the equations of one step serves the next, which may move the last digit.
  const auto expect_from = [&](std::size_t state, std::size_t mesh) {
    const Vector<S> q = between.at(recorder.seen[mesh], times[state]).q;
    EXPECT_LE(max_norm(Vector<S>(at.states()[state].q - q)), 8 * epsilon<S>()) << state;
  };
  expect_from(1, 0);
  expect_from(4, 4);
  expect_from(5, 8);
}

TYPED_TEST(StatesAtOf, MultiplesReachTheEnd) {
  using S = TypeParam;
  EXPECT_EQ(multiples_until<S>(S(1) / 2, S(2)).size(), 5u);
  EXPECT_EQ(multiples_until<S>(S(1) / 2, S(9) / 4).size(), 5u);
  EXPECT_EQ(multiples_until<S>(S(1) / 10, S(1)).back(), S(1));
  EXPECT_EQ(multiples_until<S>(S(5), S(1)).size(), 1u);
  expect_words(message_of<InputError>([] { multiples_until<S>(S(0), S(1)); }), {"not positive"});
  expect_words(message_of<InputError>([] { multiples_until<S>(S(1) / 1'000'000'000, S(1)); }), {"10^7"});
}

}  // namespace
}  // namespace hbvm::core
