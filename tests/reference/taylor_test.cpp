#include "reference/taylor.hpp"

#include "printing.hpp"
#include "problem/state_evaluator.hpp"
#include "reference/known_motion.hpp"
#include "reference/scene_tables.hpp"

namespace hbvm::core {
namespace {

void expect_near(const Vector<Mpfr>& found, const Vector<Mpfr>& expected, const Mpfr& tolerance,
                 const std::string& what) {
  ASSERT_EQ(found.size(), expected.size());
  for (Index j = 0; j < found.size(); ++j)
    EXPECT_LE(magnitude(Mpfr(found[j] - expected[j])), tolerance) << what << ", component " << j;
}

/// Pendula by Jacobi's functions and a circle, beads on a helix and over a cycloid: position, momentum and multipliers.
TEST(Taylor, FollowsClosedForms) {
  for (const unsigned digits : {25U, 60U, 150U})
    for (const char* name : {"simple_pendulum", "conical_pendulum", "bead_on_helix", "bead_on_cycloid"}) {
      const PrecisionScope scope(digits);
      const Assembled<Mpfr> scene = assemble<Mpfr>(load_scene(name));
      TaylorMotion motion(scene.problem, scene.q0, scene.p0);
      const Mpfr tolerance = 10'000 * epsilon<Mpfr>();
      for (const char* time : {"1/1000", "1", "5/2", "10"}) {
        const Mpfr t = literal<Mpfr>(time);
        motion.advance_to(t);
        const ExactPoint exact = known_motion(name, t);
        const std::string what = std::string(name) + " at " + time + " in " + std::to_string(digits) + " digits";
        expect_near(motion.q(), exact.q, tolerance, what);
        expect_near(motion.p(), exact.p, tolerance, what);
        expect_near(motion.lambda(), exact.lambda, tolerance, what);
      }
    }
}

/// Three hundred radians at some two a step: where a step began beside the circle by rounding, the next must not begin
/// further away.
TEST(Taylor, RoundingDoesNotGrowFromStepToStep) {
  const PrecisionScope scope(40);
  const std::string circle =
      "dimension = 2\n" + point("o", "[0, 0]") + body("bob", "1", "[0, -1]", "[50, 0]") + rod("o", "bob", "1");
  const Assembled<Mpfr> scene = assemble<Mpfr>(read_scene(circle, "circle"));
  TaylorMotion motion(scene.problem, scene.q0, scene.p0);
  motion.advance_to(Mpfr(6));
  const Mpfr s = sin(Mpfr(300)), c = cos(Mpfr(300));
  const Vector<Mpfr> q{{s, Mpfr(-c)}}, p{{Mpfr(50 * c), Mpfr(50 * s)}};
  EXPECT_GT(motion.steps(), 60);
  expect_near(motion.q(), q, 1'000'000 * epsilon<Mpfr>(), "position");
  expect_near(motion.p(), p, 50'000'000 * epsilon<Mpfr>(), "momentum");
}

/// A body of mass 1 and the sun, of strength 1.
Assembled<Mpfr> beside_the_sun(const std::string& position, const std::string& velocity) {
  const std::string text = "dimension = 2\n" + point("sun", "[0, 0]") + body("stone", "1", position, velocity) +
                           effect("central_gravity", "center = \"sun\"\nstrength = 1");
  return assemble<Mpfr>(read_scene(text, "sun"));
}

/// Kepler's ellipse closes after 2 pi (the third law, with unit axis and strength).
TEST(Taylor, ClosesKeplersEllipse) {
  const PrecisionScope scope(50);
  const Assembled<Mpfr> scene = beside_the_sun("[\"1/2\", 0]", "[0, \"sqrt(3)\"]");
  TaylorMotion motion(scene.problem, scene.q0, scene.p0);
  motion.advance_to(literal<Mpfr>("2*pi"));
  expect_near(motion.q(), scene.q0, 10'000 * epsilon<Mpfr>(), "position");
  expect_near(motion.p(), scene.p0, 10'000 * epsilon<Mpfr>(), "momentum");
}

/// Constraints, hidden constraints and H of scenes with every form of constraint and rigid bodies, whatever the sizes.
TEST(Taylor, KeepsWhatTheMotionKeeps) {
  for (const auto& [name, text] : built_in_scenes()) {
    const PrecisionScope scope(40);
    const Assembled<Mpfr> scene = assemble<Mpfr>(read_scene(text, name));
    TaylorMotion motion(scene.problem, scene.q0, scene.p0);
    motion.advance_to(literal<Mpfr>("1/4"));
    StateEvaluator<Mpfr> point(scene.problem);
    const Mpfr before = point.energy(scene.q0, scene.p0), size = point.energy_size(scene.q0, scene.p0);
    const Mpfr after = point.energy(motion.q(), motion.p());
    const Mpfr limit = 100'000 * epsilon<Mpfr>();
    EXPECT_LE(magnitude(Mpfr(after - before)), limit * (size + point.energy_size(motion.q(), motion.p()))) << name;
    if (scene.problem.nu() == 0) continue;
    EXPECT_LE(max_norm(point.constraints(motion.q())), limit * point.constraint_size(motion.q())) << name;
  }
}

TEST(Taylor, EndsWithATypedErrorAtASingularity) {
  const PrecisionScope scope(30);
  const Assembled<Mpfr> scene = beside_the_sun("[1, 0]", "[0, 0]");
  TaylorMotion motion(scene.problem, scene.q0, scene.p0);
  // It falls in after pi / (2 sqrt 2) = 1.11.
  EXPECT_NO_THROW(motion.advance_to(literal<Mpfr>("1.1")));
  EXPECT_THROW(motion.advance_to(literal<Mpfr>("1.2")), IntegrationError);
}

}  // namespace
}  // namespace hbvm::core
