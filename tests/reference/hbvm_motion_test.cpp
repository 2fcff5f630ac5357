#include "reference/hbvm_motion.hpp"

#include "method/hbvm.hpp"
#include "printing.hpp"
#include "reference/known_motion.hpp"
#include "reference/scene_tables.hpp"

namespace hbvm::core {
namespace {

constexpr unsigned walk_digits = 40;

/// A particle on a line in the field -U'(x).
Scene particle(const std::string& U) {
  return read_scene("dimension = 2\n" + body("a", "1", "[1, 0]", "[0, 0]") + formula(U), "particle");
}

struct Walked {
  Vector<Mpfr> q, p;
  long steps;
};
Walked walk(const Scene& text, const char* time) {
  const Assembled<Mpfr> scene = assemble<Mpfr>(text);
  const Hbvm<Mpfr> method = make_hbvm<Mpfr>(16, 16);
  const Mpfr t = literal<Mpfr>(time);
  HbvmMotion way(scene.problem, method, scene.q0, scene.p0, walk_digits - 4, t);
  Mpfr last = 0;
  way.advance_to(t, [&last](const Mpfr& now) {
    EXPECT_GT(now, last);
    last = now;
  });
  EXPECT_EQ(last, t);
  return {way.state().q, way.state().p, way.steps()};
}

TEST(HbvmMotion, FollowsKnownMotions) {
  const PrecisionScope scope(walk_digits);
  for (const char* name : {"simple_pendulum", "conical_pendulum"}) {
    const ExactPoint exact = known_motion(name, literal<Mpfr>("7/3"));
    const Walked found = walk(load_scene(name), "7/3");
    EXPECT_LE(distance(found.q, exact.q), literal<Mpfr>("1e-34")) << name;
  }
  const Walked oscillator = walk(particle("-x^2/2"), "10");
  EXPECT_LE(magnitude(Mpfr(oscillator.q[0] - cos(Mpfr(10)))), literal<Mpfr>("1e-34"));
  EXPECT_LE(oscillator.steps, 20);
}

/// Free fall is a polynomial: a step is as long as the time, once it is known to be.
TEST(HbvmMotion, TakesLongStepsWhereItMay) {
  const PrecisionScope scope(walk_digits);
  const Walked fall = walk(particle("-x"), "1000");
  EXPECT_EQ(fall.q[0], 1 - literal<Mpfr>("500000"));
  EXPECT_LE(fall.steps, 20);
}

/// A bump that no node of a usual step would feel: steps become short where it is, and long again.
TEST(HbvmMotion, ShortensItsStepsBeforeABump) {
  const PrecisionScope scope(walk_digits);
  const Walked found = walk(particle("-x^2/2 - exp(-((x - 1/5)*1000)^2)/4"), "3");
  // By quadrature of the time to pass.
  EXPECT_LE(magnitude(Mpfr(found.q[0] + literal<Mpfr>("0.98989641182588406"))), literal<Mpfr>("1e-17"));
  EXPECT_GT(found.steps, 40);
  EXPECT_LT(found.steps, 400);
}

/// What it cannot pass it names, with the time: a kink, and a collision.
TEST(HbvmMotion, EndsWhereNoStepIsShortEnough) {
  const PrecisionScope scope(walk_digits);
  const auto end_of = [](const Scene& scene) { return message_of<IntegrationError>([&] { walk(scene, "5"); }); };
  expect_words(end_of(particle("-sqrt(x^2)")), {"beyond t = 1.414213562", "effect 'formula': a square root of 0"});
  expect_words(end_of(particle("1/x")), {"beyond t = 1.11072073"});  // pi/(2 sqrt 2)
}

}  // namespace
}  // namespace hbvm::core
