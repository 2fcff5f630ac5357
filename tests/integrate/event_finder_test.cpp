#include "integrate/event_finder.hpp"

#include <random>

#include "integrate/runs.hpp"
#include "integrate/states_at.hpp"
#include "printing.hpp"
#include "scalar/text.hpp"
#include "scene/add_event.hpp"
#include "step/hbvm_method.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

Scene pendulum(const std::string& speed) {
  return read_scene(
      "dimension = 2\npoint = [{ name = \"o\", position = [0, 0] }]\n"
      "body = [{ name = \"bob\", mass = 1, position = [0, -1], velocity = [\"" +
          speed +
          "\", 0] }]\nconstraint = [{ kind = \"rod\", between = [\"o\", \"bob\"], length = 1 }]\n"
          "effect = [{ kind = \"uniform_gravity\", acceleration = [0, -1] }]\n",
      "pendulum");
}

/// Events of a run by HBVM(2s,s).
template <Scalar S>
std::vector<FoundEvent<S>> events_of(const Scene& scene, int s, const char* step, const char* until,
                                     std::optional<LastEvent> last = {}) {
  SceneRun<S> run(scene, 2 * s, s, step, until, SolverKind::newton);
  BetweenSteps<S> between(hbvm_of({2 * s, s})->make_stepper<S>(run.scene.problem, SolverKind::automatic));
  EventFinder<S> finder(scene, run.scene.problem, between, last);
  run({&finder});
  return finder.found();
}

/// 4 K(k) by the mean of Gauss, k = sin(a/2).
Mpfr period(const Mpfr& k) {
  Mpfr a = 1, b = sqrt(Mpfr(1 - k * k));
  while (magnitude(Mpfr(a - b)) > epsilon<Mpfr>() * a * 4) {
    const Mpfr mean = (a + b) / 2;
    b = sqrt(Mpfr(a * b));
    a = mean;
  }
  return 8 * atan(Mpfr(1)) / a;
}

class EventFinderTest : public InDigits<60> {};

/// The pendulum's period to 50 digits at ten amplitudes: its speed at the bottom is 2 sin(a/2).
TEST_F(EventFinderTest, FindsThePeriodOfThePendulum) {
  for (int n = 1; n <= 10; ++n) {
    const std::string speed = std::to_string(n) + "/6";
    const auto found = events_of<Mpfr>(with_event(pendulum(speed), "up: bob.x"), 24, "1/4", "12");
    const Mpfr exact = period(Mpfr(n) / 12);
    ASSERT_GE(found.size(), 2u) << n;
    std::size_t up = 0;
    while (!found[up].rises) ++up;
    EXPECT_LE(magnitude(Mpfr(found[up].state.t - exact)), pow(Mpfr(10), -50) * exact) << to_text(found[up].state.t);
  }
}

/// The cycloid's period is pi sqrt(17), whatever the amplitude.
TEST_F(EventFinderTest, FindsThePeriodOfTheCycloid) {
  for (int n = 1; n <= 5; ++n) {
    const std::string v = std::to_string(n) + "/10";
    const Scene scene = with_event(
        read_scene("dimension = 3\nbody = [{ name = \"bead\", mass = 1, position = [0, 0, 0], velocity = [\"" + v +
                       "\", 0, \"" + v +
                       "/4\"] }]\n[[constraint]]\nkind = \"formula\"\non = \"bead\"\n"
                       "g = \"x - 2*atan(z/sqrt(1 - z^2)) - 2*z*sqrt(1 - z^2)\"\n"
                       "[[constraint]]\nkind = \"formula\"\non = \"bead\"\ng = \"y - 2*z^2\"\n"
                       "[[effect]]\nkind = \"uniform_gravity\"\nacceleration = [0, -1, 0]\n",
                   "cycloid"),
        "up up: bead.z");
    const auto found = events_of<Mpfr>(scene, 24, "1/2", "14");
    ASSERT_EQ(found.size(), 1u) << n;
    const Mpfr exact = 4 * atan(Mpfr(1)) * sqrt(Mpfr(17));
    EXPECT_LE(magnitude(Mpfr(found[0].state.t - exact)), pow(Mpfr(10), -50) * exact) << to_text(found[0].state.t);
  }
}

template <class S>
class EventFinderOf : public InDigits<40> {};
TYPED_TEST_SUITE(EventFinderOf, AllScalars, ScalarNames);

TYPED_TEST(EventFinderOf, TellsDirectionsInOrder) {
  using S = TypeParam;
  const Scene scene = with_event(with_event(pendulum("1"), "left: bob.x"), "turn down: bob.vx");
  const auto found = events_of<S>(scene, 6, "1/8", "7");
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0].event, 1u);
  EXPECT_FALSE(found[0].rises);
  EXPECT_EQ(found[1].event, 0u);
  EXPECT_FALSE(found[1].rises);
  EXPECT_TRUE(found[2].rises);
  // Twice the time from the bottom to the turn is that from bottom to bottom.
  EXPECT_LE(magnitude(S(2 * found[0].state.t - found[1].state.t)), S(1) / 100'000'000);
  EXPECT_LE(magnitude(found[1].state.q[0]), 64 * epsilon<S>());
}

/// A value that is beyond 0 for a fortieth of a step, and one that only comes to 0.
TYPED_TEST(EventFinderOf, SeesTwoCrossingsWithinAStep) {
  using S = TypeParam;
  // Near the turn the height falls with acceleration sqrt(3)/4 in x: x is above x_max - d for 2 sqrt(2 d / a).
  const Scene twice = with_event(pendulum("1"), "far: bob.x - sqrt(3)/2 + 0.0000005");
  const auto found = events_of<S>(twice, 6, "1/8", "3");
  ASSERT_EQ(found.size(), 2u);
  EXPECT_TRUE(found[0].rises);
  EXPECT_FALSE(found[1].rises);
  EXPECT_LT(S(found[1].state.t - found[0].state.t), S(1) / 8 / 20);
  EXPECT_GT(S(found[1].state.t - found[0].state.t), S(1) / 8 / 80);
  const auto none = events_of<S>(with_event(pendulum("1"), "far: bob.x - sqrt(3)/2 - 0.0000005"), 6, "1/8", "3");
  EXPECT_TRUE(none.empty());
}

TEST_F(EventFinderTest, NamesOneThatGrazes) {
  const auto found = events_of<Mpfr>(with_event(pendulum("1"), "far: bob.x - sqrt(3)/2"), 16, "1/8", "3");
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found[0].grazes, found.size() == 1);
  EXPECT_LE(magnitude(Mpfr(found[0].state.t - period(Mpfr(1) / 2) / 4)), pow(Mpfr(10), -15));
}

/// A value that jumps over 0 has no zero there, and an angle goes on over full turns.
TYPED_TEST(EventFinderOf, LeavesJumpsAndFollowsAngles) {
  using S = TypeParam;
  EXPECT_TRUE(events_of<S>(with_event(pendulum("1"), "pole: 1/(bob.x - 1/2)"), 6, "1/8", "4").empty());
  EXPECT_TRUE(events_of<S>(with_event(pendulum("1"), "jump: atan(1/(bob.x - 1/3))"), 6, "1/8", "4").empty());
  const auto turns = events_of<S>(with_event(pendulum("3"), "turns: angle(o, bob) - 5*pi/2"), 6, "1/8", "6");
  ASSERT_EQ(turns.size(), 1u);
  EXPECT_LE(magnitude(turns[0].state.q[0]), S(1) / 1'000'000);
}

TEST_F(EventFinderTest, EndsWhereItIsAsked) {
  const Scene scene = with_event(pendulum("1"), "up up: bob.x");
  try {
    events_of<double>(scene, 6, "1/8", "100", LastEvent{0, 3});
    FAIL();
  } catch (const EventReached& reached) {
    EXPECT_NEAR(std::stod(reached.t), 3 * approximately(period(Mpfr(1) / 2)), 1e-9);
  }
}

/// Random expressions on random starts against a fine search: none is missed that is beyond 0 for a fiftieth of a step.
TEST_F(EventFinderTest, MissesNoneThatAFineSearchFinds) {
  std::mt19937 random(7);
  const auto number = [&](int most) { return std::to_string(static_cast<int>(random() % (2 * most + 1)) - most); };
  int crossings = 0;
  const std::pair<const char*, const char*> others[] = {
      {"double_pendulum", "b"}, {"henon_heiles", "star"}, {"spherical_pendulum", "bob"}};
  for (int n = 0; n < 200; ++n) {
    const auto& [name, body] = others[n % 3];
    const bool is_other = n % 2 == 1;
    const std::string x = is_other ? body : "bob", a = number(9), b = number(9), c = number(9), d = number(30);
    const std::string expression =
        a + "/4*" + x + ".x*" + x + ".vy + " + b + "/5*" + x + ".y + " + c + "/3*sin(3*" + x + ".vx) + " + d + "/20";
    const std::string start = std::to_string(1 + random() % 30) + "/10";
    Scene scene = with_event(is_other ? load_scene(name) : pendulum(start), "e: " + expression);
    SceneRun<double> run(scene, 6, 3, "1/8", "8", SolverKind::newton);
    BetweenSteps<double> between(hbvm_of({6, 3})->make_stepper<double>(run.scene.problem, SolverKind::automatic));
    EventFinder<double> finder(scene, run.scene.problem, between, {});
    std::vector<double> times;
    constexpr int fine = 8 * 50;
    for (int i = 0; i <= 8 * fine; ++i) times.push_back(static_cast<double>(i) / fine);
    StatesAt<double> at(between, times, Direction::forward);
    run({&finder, &at});
    at.finish();
    Scene observed = scene;
    observed.observations = {{"e", scene.events[0].value}};
    Observations<double> values(observed, run.scene.problem);
    std::vector<double> changes;
    double before = 0;
    for (std::size_t i = 0; i < at.states().size(); ++i) {
      const StateBetween<double>& state = at.states()[i];
      const double value = values.see(state.t, state.q, state.p)[0];
      if (i > 0 && (value < 0) != (before < 0)) changes.push_back(state.t);
      before = value;
    }
    std::vector<double> found;
    for (const FoundEvent<double>& event : finder.found())
      if (!event.grazes) found.push_back(event.state.t);
    for (const double change : changes)
      EXPECT_TRUE(std::any_of(found.begin(), found.end(), [&](double t) { return std::abs(t - change) < 0.004; }))
          << scene.name << ", " << expression << " at " << change;
    crossings += static_cast<int>(changes.size());
    EXPECT_LE(found.size(), changes.size() + 4) << expression;
  }
  EXPECT_GT(crossings, 400);
}

}  // namespace
}  // namespace hbvm::core
