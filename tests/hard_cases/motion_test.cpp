#include "hard_cases/motion.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "hard_cases/measure.hpp"
#include "scene/assemble.hpp"

namespace hbvm::core {
namespace {

/// Sixteen steps of the double pendulum.
SampledMotion pendulum_motion(const Twist& twist = {}) {
  return motion_of(request_of(load_scene("double_pendulum"), "hbvm:4,2", "newton", "1/32", "1/2", "quad"), twist);
}

double number(const BigFloat& x) { return mpfr_get_d(raw(x), MPFR_RNDN); }

/// The greatest distance of two states, coordinate by coordinate.
double apart(const std::vector<BigFloat>& a, const std::vector<BigFloat>& b, double sign = 1) {
  const PrecisionScope digits(60);
  Mpfr most = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    raise_magnitude(most,
                    Mpfr(rounded_to<Mpfr>(raw(a[i])) - Mpfr(static_cast<int>(sign)) * rounded_to<Mpfr>(raw(b[i]))));
  return approximately(most);
}

TEST(HardMotions, AreSeenAtTheStartAndEightTimes) {
  const SampledMotion motion = pendulum_motion();
  const Assembled<double> scene = assemble<double>(load_scene("double_pendulum"));
  EXPECT_EQ(motion.steps, 16);
  ASSERT_EQ(motion.samples.size(), 9u);
  for (Index i = 0; i < scene.problem.m(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    EXPECT_EQ(number(motion.samples[0].q[at]), scene.q0[i]);
    for (const ExactState& sample : motion.samples) {
      EXPECT_GE(number(motion.scale.q[at]), std::abs(number(sample.q[at])));
      EXPECT_GE(number(motion.scale.p[at]), std::abs(number(sample.p[at])));
    }
  }
}

/// A kick of 2^-60 shows, and by no more than the motion makes of it.
TEST(HardMotions, MayBeKicked) {
  const SampledMotion motion = pendulum_motion(), kicked = pendulum_motion({60, false});
  const double change = apart(motion.samples.back().q, kicked.samples.back().q);
  EXPECT_GT(change, std::ldexp(1, -64));
  EXPECT_LT(change, std::ldexp(1, -50));
}

TEST(HardMotions, MayLeadBack) {
  const SampledMotion motion = pendulum_motion({0, true});
  EXPECT_LT(apart(motion.samples.front().q, motion.samples.back().q), std::ldexp(1, -100));
  EXPECT_LT(std::min(apart(motion.samples.front().p, motion.samples.back().p),
                     apart(motion.samples.front().p, motion.samples.back().p, -1)),
            std::ldexp(1, -100));
}

}  // namespace
}  // namespace hbvm::core
