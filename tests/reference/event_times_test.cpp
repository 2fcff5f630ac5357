#include "reference/event_times.hpp"

#include "printing.hpp"
#include "scene/add_event.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

ReferenceRequest request_until(const Scene& scene, const char* until, int digits) {
  ReferenceRequest request;
  request.scene = scene;
  request.times = {Expression::parse(until)};
  request.digits = digits;
  return request;
}

/// The pendulum's period to 60 digits: 4 K(1/2), by the mean of Gauss.
TEST(EventTimes, AreThoseOfTheMotion) {
  const PrecisionScope scope(90);
  const auto events = event_times(request_until(with_event(load_scene("simple_pendulum"), "swing: bob.x"), "7", 60));
  ASSERT_EQ(events.size(), 2u);
  Mpfr a = 1, b = sqrt(Mpfr(3)) / 2;
  for (int n = 0; n < 12; ++n) {
    const Mpfr mean = (a + b) / 2;
    b = sqrt(Mpfr(a * b));
    a = mean;
  }
  const Mpfr period = 8 * atan(Mpfr(1)) / a;
  EXPECT_FALSE(events[0].rises);
  EXPECT_TRUE(events[1].rises);
  EXPECT_LE(magnitude(Mpfr(evaluate<Mpfr>(events[0].t) - period / 2)), pow(Mpfr(10), -61));
  EXPECT_LE(magnitude(Mpfr(evaluate<Mpfr>(events[1].t) - period)), pow(Mpfr(10), -61));
}

TEST(EventTimes, MayBeNone) {
  EXPECT_TRUE(event_times(request_until(with_event(load_scene("kepler"), "far: planet.x - 9"), "2", 20)).empty());
}

}  // namespace
}  // namespace hbvm::core
