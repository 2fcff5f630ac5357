#include "integrate/work_done.hpp"

#include "integrate/observations.hpp"
#include "integrate/runs.hpp"
#include "printing.hpp"
#include "scalar/literal.hpp"
#include "scene/observe.hpp"
#include "scene/scene.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

const std::vector<std::string> doers{"pivot", "effect 1", "drag", ""};

class WorkDone : public InDigits<50> {};

/// By hand: dU/dt of the spring, -v.v/5 of the drag, and of the pivot the rod's force times its velocity.
TEST_F(WorkDone, PowersAreForcesTimesVelocities) {
  const Vector<Mpfr> power =
      seen_at_start(load_scene("driven_pendulum"),
                    {"power(pivot)", "power(effect 1)", "power(drag)", "power()", "force(pivot, bob, x)"});
  const Mpfr spring = -literal<Mpfr>("1/2*((3/5 - 2)^2 + (-4/5 + 1/6)^2)/2"), drag = literal<Mpfr>("-1/5*(5/6)^2");
  EXPECT_LE(magnitude(Mpfr(power[1] + spring)), 100 * epsilon<Mpfr>());
  EXPECT_LE(magnitude(Mpfr(power[2] - drag)), 100 * epsilon<Mpfr>());
  EXPECT_LE(magnitude(Mpfr(power[0] + power[4] * literal<Mpfr>("5/6"))), 100 * epsilon<Mpfr>());
  EXPECT_LE(magnitude(Mpfr(power[0] + power[1] + power[2] - power[3])), 100 * epsilon<Mpfr>());
  EXPECT_GE(magnitude(power[0]), Mpfr(1) / 10);
}

/// The work of a short run is the power in its middle times its length, to the second order.
TEST_F(WorkDone, WorksGrowByThePowers) {
  Scene scene = load_scene("driven_pendulum");
  for (const std::string what : {"work(", "power("})
    for (const std::string& doer : doers) scene = with_observation(scene, what + doer + ")", what + doer + ")");
  SceneRun<Mpfr> run(scene, 6, 6, "1e-12", "2e-12");
  Observations<Mpfr> observations(scene, run.scene.problem);
  struct Keep final : Observer<Mpfr> {
    const Observations<Mpfr>& from;
    std::vector<Vector<Mpfr>> seen;
    explicit Keep(const Observations<Mpfr>& observed) : from(observed) {}
    void observe(const Snapshot<Mpfr>&) override { seen.push_back(from.values()); }
  } keep(observations);
  run({&observations, &keep});
  ASSERT_EQ(keep.seen.size(), 3U);
  for (Index i = 0; i < 4; ++i) {
    EXPECT_LE(magnitude(keep.seen[0][i]), 100 * epsilon<Mpfr>()) << doers[static_cast<std::size_t>(i)];
    const Mpfr power = keep.seen[2][i] / (2 * run.grid.step());
    EXPECT_LE(magnitude(Mpfr(power - keep.seen[1][4 + i])), literal<Mpfr>("1e-20"))
        << doers[static_cast<std::size_t>(i)];
  }
}

TEST_F(WorkDone, IsOfWhatANameMeans) {
  const Problem<Mpfr> linkage = assemble<Mpfr>(load_scene("motor_linkage")).problem;
  EXPECT_EQ(working(linkage, "torque"), (std::vector<std::size_t>{1, 2}));
  EXPECT_EQ(working(linkage, "effect 3"), (std::vector<std::size_t>{2}));
  EXPECT_EQ(working(linkage, "effect 4 (drag)"), (std::vector<std::size_t>{3}));
  EXPECT_EQ(working(linkage, ""), (std::vector<std::size_t>{1, 2, 3}));
  expect_words(message_of<InputError>([&] { working(linkage, "damper"); }), {"'damper'", "effect 2 (torque)"});
  const Problem<Mpfr> pendulum = assemble<Mpfr>(load_scene("simple_pendulum")).problem;
  expect_words(message_of<InputError>([&] { working(pendulum, "drag"); }), {"nothing does work"});
}

}  // namespace
}  // namespace hbvm::core
