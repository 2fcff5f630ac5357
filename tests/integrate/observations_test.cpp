#include "integrate/observations.hpp"

#include "integrate/runs.hpp"
#include "printing.hpp"
#include "scene/observe.hpp"
#include "solver/error_of.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

/// A pendulum that goes round: 3 full turns or so until t = 10.
Scene turning() {
  return read_scene(
      "dimension = 2\npoint = [{ name = \"o\", position = [0, 0] }]\n"
      "body = [{ name = \"bob\", mass = 1, position = [0, -1], velocity = [3, 0] }]\n"
      "constraint = [{ kind = \"rod\", between = [\"o\", \"bob\"], length = 1 }]\n"
      "effect = [{ kind = \"uniform_gravity\", acceleration = [0, -1] }]\n"
      "observe = [{ name = \"turns\", value = \"angle(o, bob)/(2*pi)\" }]\n",
      "turning");
}

template <class S>
class ObservationsTest : public InDigits<40> {
 protected:
  /// The observation at the end, and the snapshots.
  static std::pair<S, std::vector<Snapshot<S>>> at_end(const Scene& scene, const char* step, const char* until) {
    SceneRun<S> run(scene, 8, 8, step, until, SolverKind::newton);
    Observations<S> observations(scene, run.scene.problem);
    Recorder<S> recorder;
    run({&observations, &recorder});
    return {observations.values()[0], recorder.seen};
  }
};
TYPED_TEST_SUITE(ObservationsTest, AllScalars, ScalarNames);

/// Large steps count the same turns as small ones, though the pendulum turns by more than half in a step of 3/2.
TYPED_TEST(ObservationsTest, AnglesGoOnOverFullTurns) {
  using S = TypeParam;
  const S small = this->at_end(turning(), "1/16", "9").first, large = this->at_end(turning(), "3/2", "9").first;
  EXPECT_GT(small, 3);
  EXPECT_LE(magnitude(S(small - large)), S(1) / 4);
}

TYPED_TEST(ObservationsTest, OfAStateAloneHaveAnglesWithinAHalfTurn) {
  using S = TypeParam;
  const Scene scene = turning();
  const auto [end, seen] = this->at_end(scene, "1/16", "9");
  const Assembled<S> assembled = assemble<S>(scene);
  Observations<S> observations(scene, assembled.problem);
  const S alone = observations.see(seen.back().t, seen.back().q, seen.back().p)[0], difference = end - alone;
  EXPECT_LE(magnitude(alone), S(1) / 2);
  using std::round;
  EXPECT_LE(magnitude(S(difference - round(difference))), 16 * epsilon<S>());
}

/// With the angles that were followed, a state by itself has the turns of the run.
TYPED_TEST(ObservationsTest, OfAStateAloneTurnTowardsAngles) {
  using S = TypeParam;
  const Scene scene = turning();
  const auto [end, seen] = this->at_end(scene, "1/16", "9");
  const Assembled<S> assembled = assemble<S>(scene);
  Observations<S> followed(scene, assembled.problem), alone(scene, assembled.problem);
  for (const auto& snapshot : seen) followed.observe(snapshot);
  EXPECT_TRUE(alone.has_angles());
  EXPECT_LE(magnitude(S(alone.see(seen.back().t, seen.back().q, seen.back().p, followed.angles())[0] - end)),
            16 * epsilon<S>());
}

/// A run that goes on from what was kept counts on.
TYPED_TEST(ObservationsTest, AreKeptWithTheirRun) {
  using S = TypeParam;
  const Scene scene = turning();
  const auto [end, seen] = this->at_end(scene, "1/16", "9");
  const Assembled<S> assembled = assemble<S>(scene);
  Observations<S> first(scene, assembled.problem), second(scene, assembled.problem);
  const std::size_t half = seen.size() / 2;
  for (std::size_t n = 0; n < half; ++n) first.observe(seen[n]);
  Archive kept;
  first.remember(kept);
  Archive read(kept.text());
  second.remember(read);
  for (std::size_t n = half; n < seen.size(); ++n) second.observe(seen[n]);
  EXPECT_EQ(second.values()[0], end);
  // The least was met in the first half, the greatest in the second.
  EXPECT_EQ(second.least().values[0], first.least().values[0]);
  EXPECT_EQ(second.greatest().values[0], end);
  EXPECT_EQ(second.greatest().times[0], seen.back().t);
}

/// Of the height of the pendulum, which is lowest at the start and highest in every turn.
TYPED_TEST(ObservationsTest, TellTheirRange) {
  using S = TypeParam;
  Scene scene = turning();
  scene.observations.clear();
  scene = with_observation(scene, "height", "bob.y + 5");
  SceneRun<S> run(scene, 8, 8, "1/16", "9", SolverKind::newton);
  Observations<S> observations(scene, run.scene.problem);
  Recorder<S> recorder;
  run({&observations, &recorder});
  const auto lower = [](const Snapshot<S>& a, const Snapshot<S>& b) { return a.q[1] < b.q[1]; };
  const auto [lowest, highest] = std::minmax_element(recorder.seen.begin(), recorder.seen.end(), lower);
  EXPECT_EQ(observations.least().values[0], S(lowest->q[1] + 5));
  EXPECT_EQ(observations.least().times[0], lowest->t);
  EXPECT_EQ(observations.greatest().values[0], S(highest->q[1] + 5));
  EXPECT_EQ(observations.greatest().times[0], highest->t);
  EXPECT_GT(highest->q[1], 0);
}

TEST(ObservationsErrors, NameTheTimeWhereThereIsNoValue) {
  // log of what becomes negative when the bob has passed its lowest point.
  Scene scene = turning();
  scene = with_observation(scene, "L", "log(1/2 - bob.x)");
  SceneRun<double> run(scene, 2, 2, "1/16", "1");
  Observations<double> observations(scene, run.scene.problem);
  expect_words(message_of<IntegrationError>([&] { run({&observations}); }), {"observe 'L'", "no value at t = 0."});
}

TEST(ObservationsErrors, NameFileAndLine) {
  const Scene scene = read_scene(
      "dimension = 2\nbody = [{ name = \"a\", mass = 1, position = [0, 0], velocity = [0, 0] }]\n\n[[observe]]\n"
      "name = \"n\"\nvalue = \"b.x\"\n",
      "file.toml");
  const Assembled<double> assembled = assemble<double>(scene);
  expect_words(message_of<InputError>([&] { Observations<double>(scene, assembled.problem); }),
               {"file.toml:4", "observe 'n'", "there is no body or point 'b'"});
}

}  // namespace
}  // namespace hbvm::core
