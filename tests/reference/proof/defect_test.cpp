#include "reference/proof/defect.hpp"

#include "hbvm/error.hpp"
#include "printing.hpp"
#include "reference/proof/holds.hpp"
#include "reference/scene_tables.hpp"

namespace hbvm::core {
namespace {

/// The first step of a scene by its Taylor series in few digits, looked at with many.
struct FirstStep {
  FirstStep(const Scene& scene, unsigned digits)
      : scope(digits),
        bits(1'000),
        proved(scene),
        balls(proved.balls()),
        motion(proved.rounded.problem, proved.rounded.q0, proved.rounded.p0),
        step(step_of(motion, balls)) {}

  Defect bound(const SeriesStep& of) {
    return DefectBound(balls, proved.exact.problem).of(of, proved.rounded.q0, proved.rounded.p0);
  }

  /// The length of e in the metric M^-1, at s.
  RealBall force_defect(const SeriesStep& of, const RealBall& s) const {
    std::vector<RealBall> e = balls.momentum(of.accelerations(s));
    const std::vector<BallSeries> q = as_series(of.positions(s));
    const std::vector<BallSeries> F = balls.force(q, 1);
    for (std::size_t j = 0; j < e.size(); ++j) e[j] -= F[j][0];
    for (Index a = 0; a < balls.nu(); ++a)
      for (const BallSlope& slope : balls.slopes(a, q, 1))
        e[static_cast<std::size_t>(slope.coordinate)] +=
            slope.series[0] * of.lambda()[static_cast<std::size_t>(a)].at(s);
    const std::vector<RealBall> pulled = balls.velocity(e);
    RealBall square;
    for (std::size_t j = 0; j < e.size(); ++j) square += e[j] * pulled[j];
    return square_root(square);
  }

  PrecisionScope scope;
  BallScope bits;
  ProvedScene proved;
  BallProblem balls;
  TaylorMotion motion;
  SeriesStep step;
};

double log2_of_size(const RealBall& x) {
  mag_t size;
  mag_init(size);
  arb_get_mag(size, raw(x));
  const double result = mag_get_d_log2_approx(size);
  mag_clear(size);
  return result;
}

/// A bound is no less than what it bounds, and not much more: few bits are lost to Cauchy's estimate.
TEST(Defect, IsBoundedCloseToWhatItIs) {
  for (const char* name : {"double_pendulum", "tethered_satellites", "heavy_top", "bead_on_torus", "bead_on_helix",
                           "kepler", "henon_heiles", "toda_lattice", "charged_double_pendulum"}) {
    FirstStep first(load_scene(name), 30);
    const Defect bound = first.bound(first.step);
    RealBall greatest;
    for (int i = 0; i <= 32; ++i) {
      RealBall s;
      arb_get_mid_arb(raw(s), raw(first.step.end() * RealBall(i) / RealBall(32)));
      const RealBall found = greatest_magnitude(first.force_defect(first.step, s));
      EXPECT_FALSE(bound.force.is_below(found)) << name << " at part " << i;
      greatest = greater(greatest, found);
    }
    EXPECT_LT(log2_of_size(bound.force), log2_of_size(greatest) + 36) << name;
    EXPECT_EQ(static_cast<Index>(bound.bending.size()), first.balls.nu());
  }
}

/// A coefficient that is off by 1e-30 among those of 60 digits is seen, whichever it is: of a position, of a
/// multiplier.
TEST(Defect, SeesACoefficientThatIsOff) {
  FirstStep first(load_scene("double_pendulum"), 60);
  const Defect right = first.bound(first.step);
  RealBall little;
  arb_set_str(raw(little), "1e-30", 64);
  EXPECT_TRUE(right.force.is_below(little / power(RealBall(10), 10)));
  for (const Index n : {2, 5, 20}) {
    std::vector<BallSeries> q = first.step.q(), lambda = first.step.lambda();
    q[1].set(n, q[1][n] + little);
    const SeriesStep moved(q, lambda, first.step.unit(), first.step.end(), first.step.order());
    EXPECT_TRUE((little / RealBall(1'000)).is_below(first.bound(moved).force)) << n;
    lambda[0].set(n, lambda[0][n] + little);
    const SeriesStep pulled(first.step.q(), lambda, first.step.unit(), first.step.end(), first.step.order());
    EXPECT_TRUE((little / RealBall(1'000)).is_below(first.bound(pulled).force)) << n;
  }
  // Off the rod the second derivative of g shows it.
  std::vector<BallSeries> q = first.step.q();
  for (BallSeries& x : q) x.set(3, x[3] + little);
  const SeriesStep moved(q, first.step.lambda(), first.step.unit(), first.step.end(), first.step.order());
  const Defect bent = first.bound(moved);
  EXPECT_TRUE((little / RealBall(1'000)).is_below(greater(bent.bending[0], bent.bending[1])));
}

/// Of free fall all of it is a polynomial: nothing is left out.
TEST(Defect, OfAPolynomialMotionIsRounding) {
  const Scene fall =
      read_scene("dimension = 2\n" + body("a", "3", "[1, 2]", "[\"1/4\", 0]") + field("[0, -1]"), "fall");
  FirstStep first(fall, 30);
  EXPECT_LT(log2_of_size(first.bound(first.step).force), -90);
}

/// A force that the series does not feel, within the reach of the circle, has no bound.
TEST(Defect, IsNotBoundedAcrossAHiddenForce) {
  const std::string oscillator = "dimension = 2\n" + body("a", "1", "[1, 0]", "[0, 0]");
  FirstStep smooth(read_scene(oscillator + formula("-x^2/2 - y^2/2"), "smooth"), 40);
  EXPECT_NO_THROW(smooth.bound(smooth.step));
  FirstStep bump(read_scene(oscillator + formula("-x^2/2 - y^2/2 - exp(-((x - 1/5)/1000^(-1))^2)/10^9"), "bump"), 40);
  // The smooth oscillator's step, as long as that is.
  EXPECT_THROW(bump.bound(smooth.step), IntegrationError);
}

}  // namespace
}  // namespace hbvm::core
