#include "reference/between/force_bounds.hpp"

#include <cmath>

#include "printing.hpp"
#include "reference/scene_tables.hpp"
#include "scene/assemble.hpp"

namespace hbvm::core {
namespace {

/// An oscillator from rest at x = 1, whose motion is cos t, and forces beside it.
class Oscillator {
 public:
  explicit Oscillator(const std::string& U)
      : scene_(assemble<Mpfr>(read_scene(
            "dimension = 2\n" + body("a", "1", "[1, 0]", "[0, 0]") + formula("-x^2/2 - y^2/2" + U), "oscillator"))),
        bounds_(scene_.problem) {
    bounds_.start(scene_.q0, scene_.p0);
    Mpfr term = 1;
    for (Index n = 0; n <= order; ++n) {
      x_.push_back(n % 2 == 0 ? term : Mpfr(0));
      if (n % 2 == 1) term /= -n * (n + 1);
    }
  }

  /// On a circle of so many steps of length h.
  bool hold(double h, double radii) {
    const Mpfr zero = 0;
    return bounds_.hold(std::log2(h), [&](std::size_t, Index input) {
      return circle_of([&](Index n) -> const Mpfr& { return input == 0 ? x_[static_cast<std::size_t>(n)] : zero; },
                       order, std::log2(h * radii));
    });
  }
  std::string obstacle() const { return bounds_.obstacle(); }

 private:
  static constexpr Index order = 60;
  PrecisionScope scope_{40};
  Assembled<Mpfr> scene_;
  ForceBounds bounds_;
  std::vector<Mpfr> x_;
};

TEST(ForceBounds, HoldForWhatTheStartShows) {
  EXPECT_TRUE(Oscillator("").hold(0.5, 4));
  EXPECT_TRUE(Oscillator("").hold(1, 5));
  EXPECT_TRUE(Oscillator(" - y^4/4").hold(1, 5));
}

/// What is felt nowhere near the start is seen by a circle that comes near it, be it as weak as it may. An entire bump
/// is huge at imaginary distances.
TEST(ForceBounds, SeeWhatTheStartDoesNotFeel) {
  for (const char* height : {"1/4", "1e-9", "1e-25"})
    for (const char* width : {"1e-2", "1e-5", "1e-8"}) {
      Oscillator bump(std::string(" - ") + height + "*exp(-((x - 1/5)/" + width + ")^2)");
      EXPECT_TRUE(bump.hold(0.2, 4)) << height << " " << width;
      EXPECT_FALSE(bump.hold(0.5, 4)) << height << " " << width;
      EXPECT_EQ(bump.obstacle(), "effect 'formula': a force that changes too much");
    }
  Oscillator centre(" + 1e-30/((x - 1/5)^2 + y^2)");
  EXPECT_TRUE(centre.hold(0.2, 4));
  EXPECT_FALSE(centre.hold(0.5, 4));
  EXPECT_EQ(centre.obstacle().substr(0, 16), "effect 'formula'");
}

/// Units that are powers of two change nothing.
TEST(ForceBounds, ComparesBodiesWithThemselves) {
  const auto two = [](const char* mass) {
    const Assembled<Mpfr> scene = assemble<Mpfr>(
        read_scene("dimension = 2\n" + body("a", mass, "[1, 0]", "[0, 1]") + body("b", "1", "[5, 0]", "[1, 0]") +
                       effect("formula", "on = [\"a\"]\nU = \"m*exp(-((x - 1.01)*1000)^2)\""),
                   "two"));
    ForceBounds bounds(scene.problem);
    bounds.start(scene.q0, scene.p0);
    const Mpfr one = 1, zero = 0;
    return bounds.hold(std::log2(0.25), [&](std::size_t, Index input) {
      return circle_of([&](Index n) -> const Mpfr& { return (n == 0) == (input == 0) ? one : zero; }, 1, 0);
    });
  };
  const PrecisionScope scope(40);
  EXPECT_EQ(two("1"), two("1e-20"));
}

}  // namespace
}  // namespace hbvm::core
