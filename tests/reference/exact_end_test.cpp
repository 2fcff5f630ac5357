#include "reference/exact_end.hpp"

#include "hbvm/error.hpp"
#include "printing.hpp"
#include "reference/known_motion.hpp"
#include "scalar/literal.hpp"
#include "scene/assemble.hpp"

namespace hbvm::core {
namespace {

TEST(ExactEnd, IsThatOfTheClosedFormByEitherRoute) {
  const PrecisionScope scope(35);
  const Mpfr t = literal<Mpfr>("7/3");
  const ExactPoint exact = known_motion("simple_pendulum", t);
  const Assembled<Mpfr> scene = assemble<Mpfr>(load_scene("simple_pendulum"));
  for (const Route route : {Route::taylor, Route::hbvm}) {
    long looks = 0;
    const ExactPoint end = exact_end(scene.problem, scene.q0, scene.p0, t, route, [&looks] { ++looks; });
    EXPECT_LE(distance(end.q, exact.q), literal<Mpfr>("1e-29")) << name_of(route);
    EXPECT_LE(distance(end.p, exact.p), literal<Mpfr>("1e-29")) << name_of(route);
    EXPECT_EQ(end.lambda.size(), 1);
    EXPECT_GT(looks, 0);
  }
  EXPECT_THROW(exact_end(scene.problem, scene.q0, scene.p0, t, Route::closed_form, [] {}), InputError);
}

/// A signal is looked at on the way.
TEST(ExactEnd, CanBeInterrupted) {
  const PrecisionScope scope(35);
  const Assembled<Mpfr> scene = assemble<Mpfr>(load_scene("simple_pendulum"));
  struct Ended {};
  for (const Route route : {Route::taylor, Route::hbvm})
    EXPECT_THROW(exact_end(scene.problem, scene.q0, scene.p0, Mpfr(3), route, [] { throw Ended(); }), Ended);
}

}  // namespace
}  // namespace hbvm::core
