#pragma once

#include "reference/taylor_step.hpp"
#include "scene/assemble.hpp"

namespace hbvm::core {

/// Whether a number is in a ball.
inline bool holds(const RealBall& ball, const Mpfr& x) { return arb_contains(raw(ball), raw(exact_ball(raw(x)))) != 0; }

inline double radius_of(const RealBall& ball) { return mag_get_d(arb_radref(raw(ball))); }

inline std::string text_of(const RealBall& ball) {
  char* const text = arb_get_str(raw(ball), 40, 0);
  const std::string result = text;
  flint_free(text);
  return result;
}

/// All of them.
inline void expect_held(const std::vector<RealBall>& balls, const Vector<Mpfr>& x, const std::string& what) {
  ASSERT_EQ(static_cast<Index>(balls.size()), x.size()) << what;
  for (Index i = 0; i < x.size(); ++i)
    EXPECT_TRUE(holds(balls[static_cast<std::size_t>(i)], x[i]))
        << what << ", component " << i << ": " << text_of(balls[static_cast<std::size_t>(i)]) << " and " << x[i];
}

/// A scene in the digits of the scope, and in twice as many.
struct ProvedScene {
  explicit ProvedScene(const Scene& scene)
      : exact([&] {
          const PrecisionScope twice(2 * Mpfr::thread_default_precision() + 20);
          return assemble<Mpfr>(scene);
        }()),
        rounded(assemble<Mpfr>(scene)) {}

  BallProblem balls() const {
    const PrecisionScope twice(2 * Mpfr::thread_default_precision() + 20);
    const BallScope bits(significand_bits<Mpfr>());
    return BallProblem(exact.problem);
  }

  Assembled<Mpfr> exact, rounded;
};

}  // namespace hbvm::core
