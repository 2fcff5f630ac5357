#include "reference/proved_states.hpp"

#include "hbvm/error.hpp"
#include "printing.hpp"
#include "reference/proof/holds.hpp"
#include "reference/request_of.hpp"
#include "scalar/literal.hpp"

namespace hbvm::core {
namespace {

/// The start of a pendulum, known but for a radius.
ProvedState start_within(const Scene& scene, double radius) {
  const Assembled<Mpfr> at = assemble<Mpfr>(scene);
  ProvedState state;
  for (const Mpfr& x : at.q0) state.q.push_back(widened(exact_ball(raw(x)), exact_ball(radius)));
  for (const Mpfr& x : at.p0) state.p.push_back(exact_ball(raw(x)));
  state.lambda.push_back(RealBall(1));
  state.H = RealBall(-1);
  return state;
}

TEST(ProvedStates, TellHowManyDigitsAreMissing) {
  const PrecisionScope digits(40);
  const Scene scene = load_scene("simple_pendulum");
  const auto missing = [&](double radius) {
    ProvedStates states(scene);
    states.add(start_within(scene, radius));
    return states.missing_digits(20);
  };
  // Of a position of size 1 a hundredth of a unit of digit 20 is 1e-22.
  EXPECT_LE(missing(0.9e-22), 0);
  EXPECT_GT(missing(1.2e-22), 0);
  EXPECT_NEAR(missing(1e-18), 4, 1);
}

TEST(ProvedStates, HaveARadiusRoundedUp) {
  const PrecisionScope digits(40);
  const ReferenceRequest request = request_of("simple_pendulum", {"1"}, 10);
  ProvedStates states(request.scene);
  states.add(start_within(request.scene, 1e-15));
  Reference reference;
  states.write(reference, request, Agreement(states.scene, request.times, {states.run}, 10));
  EXPECT_EQ(reference.proved, 10);
  const Mpfr radius = literal<Mpfr>(reference.times[0].radius->q);
  EXPECT_GE(radius, literal<Mpfr>("1e-15"));
  EXPECT_LE(radius, literal<Mpfr>("1.03e-15"));
  EXPECT_EQ(reference.times[0].radius->lambda, "0");
}

TEST(ProvedStates, ATimeIsBelievedWithMoreDigits) {
  const PrecisionScope digits(40);
  const RealBall third = time_for_proof(Expression::parse("1/3"), {});
  EXPECT_LT(radius_of(third), 1e-60);
  EXPECT_TRUE(holds(third * RealBall(3) - RealBall(1), Mpfr(0)));
}

}  // namespace
}  // namespace hbvm::core
