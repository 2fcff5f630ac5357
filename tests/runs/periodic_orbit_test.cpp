#include "run/periodic_orbit.hpp"

#include <gtest/gtest.h>

#include "printing.hpp"
#include "reference/taylor.hpp"
#include "scalar/literal.hpp"
#include "scalar/log2_of.hpp"
#include "scene/set_number.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

PeriodicOrbit orbit_of(const Scene& scene, const std::string& until, int digits) {
  return periodic_orbit({.scene = scene, .until = Expression::parse(until), .digits = digits});
}

/// The period of a pendulum of length 1 in a field of 1 that has this H: 2 pi / agm(1, cos(a/2)), where H = -cos a.
Mpfr period_of_pendulum(const Mpfr& H) {
  Mpfr pi = 0, mean = 0;
  mpfr_const_pi(raw(pi), MPFR_RNDN);
  const Mpfr one = 1, cosine = sqrt(Mpfr((1 - H) / 2));
  mpfr_agm(raw(mean), raw(one), raw(cosine), MPFR_RNDN);
  return 2 * pi / mean;
}

TEST(PeriodicOrbitTest, HasThePeriodOfAPendulum) {
  const PrecisionScope scope(80);
  const PeriodicOrbit orbit = orbit_of(load_scene("simple_pendulum"), "8", 60);
  EXPECT_LT(log10_of(Mpfr(orbit.period - period_of_pendulum(orbit.H))), -62);
  EXPECT_GT(orbit.agreed, 60);
}

/// Kepler's third law. The start is periodic: it stays what it is, to the last digit.
TEST(PeriodicOrbitTest, LeavesAPeriodicStartWhereItIs) {
  const PrecisionScope scope(80);
  const PeriodicOrbit orbit = orbit_of(load_scene("kepler"), "7", 50);
  Mpfr pi = 0;
  mpfr_const_pi(raw(pi), MPFR_RNDN);
  EXPECT_LT(log10_of(Mpfr(orbit.period - 2 * pi)), -52);
  EXPECT_EQ(orbit.start.q[0], literal<Mpfr>("0.5"));
  for (const std::complex<double>& multiplier : orbit.multipliers) EXPECT_NEAR(std::abs(multiplier), 1, 1e-6);
}

/// From a start that is not periodic: it has the same H, and the motion from it comes back.
TEST(PeriodicOrbitTest, IsFoundNearAStart) {
  for (const auto& [name, until] : {std::pair("henon_heiles", "8"), {"double_pendulum", "14"}}) {
    const Scene scene = load_scene(name);
    const PeriodicOrbit orbit = orbit_of(scene, until, 40);
    const PrecisionScope scope(70);
    const Assembled<Mpfr> assembled = assemble<Mpfr>(scene);
    StateEvaluator<Mpfr> point(assembled.problem);
    const Mpfr H = point.energy(assembled.q0, assembled.p0);
    EXPECT_LT(log10_of(Mpfr(orbit.H - H)), -42) << name;
    EXPECT_GT(log10_of(distance(orbit.start.q, assembled.q0)), -3) << name;
    TaylorMotion motion(assembled.problem, orbit.start.q, orbit.start.p);
    motion.advance_to(orbit.period);
    EXPECT_LT(log10_of(distance(motion.q(), orbit.start.q)), -41) << name;
    EXPECT_LT(log10_of(distance(motion.p(), orbit.start.p)), -41) << name;
    ASSERT_EQ(orbit.multipliers.size(), 4u);
    // Symplectic: they come in pairs whose product is 1.
    std::complex<double> product = 1;
    for (const std::complex<double>& multiplier : orbit.multipliers) product *= multiplier;
    EXPECT_NEAR(std::abs(product - 1.0), 0, 1e-6) << name;
  }
}

TEST(PeriodicOrbitTest, StartsInThePlane) {
  PeriodicRequest request{.scene = load_scene("double_pendulum"), .until = Expression::parse("14")};
  request.plane = Expression::parse("a.x + 1/10", Expression::Syntax::observation);
  const PeriodicOrbit orbit = periodic_orbit(request);
  const PrecisionScope scope(40);
  EXPECT_LT(log10_of(Mpfr(orbit.start.q[0] + literal<Mpfr>("0.1"))), -32);
}

TEST(PeriodicOrbitTest, IsRefusedWhereThereIsNone) {
  EXPECT_THROW(orbit_of(load_scene("driven_pendulum"), "8", 30), InputError);
  for (const auto& [scene, until, words] :
       {std::tuple("henon_heiles", "1/2", "does not come back"), {"bead_on_quartic", "5", "no periodic motion"}})
    try {
      orbit_of(load_scene(scene), until, 30);
      ADD_FAILURE() << scene;
    } catch (const IntegrationError& error) {
      expect_words(error.what(), {words});
    }
}

}  // namespace
}  // namespace hbvm::core
