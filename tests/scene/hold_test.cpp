#include "scene/hold.hpp"

#include <gtest/gtest.h>

#include "printing.hpp"
#include "scene/project.hpp"
#include "scene_text.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

/// A slider-crank of bars in the plane, whose crank is at 60 degrees. The rod and the slider are drawn badly.
const char* const rough_sketch = R"(dimension = 2
[[point]]
name = "ground"
position = [0, 0]
[[rigid_body]]
name = "crank"
fixed_at = [0, 0]
mass = 1
center = ["1/4", 0]
inertia = "1/48"
orientation = "pi/3"
angular_velocity = 20
[[rigid_body]]
name = "rod"
position = [0.2, 0.4]
velocity = [0, 0]
mass = 2
center = ["3/4", 0]
inertia = "3/8"
orientation = 0.2
angular_velocity = 0
[[body]]
name = "slider"
mass = 3
position = [1.5, 0.1]
velocity = [0, 0]
[[constraint]]
kind = "ball_joint"
between = [{ of = "crank", at = ["1/2", 0] }, { of = "rod", at = [0, 0] }]
[[constraint]]
kind = "ball_joint"
between = [{ of = "rod", at = ["3/2", 0] }, "slider"]
[[constraint]]
kind = "plane"
body = "slider"
normal = [0, 1]
offset = 0
)";

template <class S>
class Hold : public InDigits<50> {
 protected:
  static Scene projected(const std::string& text, const std::vector<std::string>& names) {
    const Scene scene = read_scene(text, "test.toml");
    Scene result = project<S>(scene, held_parts(scene, names));
    assemble<S>(result);
    return result;
  }
  static void expect_near(const Expression& found, const S& expected, const char* what) {
    EXPECT_LE(magnitude(S(evaluate<S>(found) - expected)), 512 * epsilon<S>()) << what << " is " << found.text();
  }
};
TYPED_TEST_SUITE(Hold, AllScalars, ScalarNames);

/// Angle and rate stay as they are written, and the rest follows. The crank's end is at x_c = 1/4, h = sqrt(3)/4. The
/// rod of length l = 3/2 reaches the line at x = x_c + w, w = sqrt(l^2 - h^2). Its speed there is -20 h (1 + x_c/w).
TYPED_TEST(Hold, KeepsTheAngleAndTheRateOfACrank) {
  using S = TypeParam;
  using std::sqrt;
  const Scene before = read_scene(rough_sketch, "test.toml");
  const Scene scene = this->projected(rough_sketch, {"crank.angle", "crank.rate"});
  for (std::size_t a = 0; a < 2; ++a)
    for (std::size_t j = 0; j < 2; ++j)
      EXPECT_EQ(scene.rigid_bodies[0].directors[a][j].text(), before.rigid_bodies[0].directors[a][j].text());
  EXPECT_EQ(scene.rigid_bodies[0].angular_velocity[0].text(), "20");
  const S h = sqrt(S(3)) / 4, w = sqrt(S(9) / 4 - h * h), x_c = S(1) / 4;
  this->expect_near(scene.bodies[0].position[0], S(x_c + w), "x");
  this->expect_near(scene.bodies[0].position[1], S(0), "y");
  const S speed = -20 * h * (1 + x_c / w);
  EXPECT_LE(magnitude(S(evaluate<S>(scene.bodies[0].velocity[0]) - speed)), 10'000 * epsilon<S>());
}

/// Without a hold the crank gives way.
TYPED_TEST(Hold, IsWhatKeepsThem) {
  using S = TypeParam;
  const Scene scene = this->projected(rough_sketch, {});
  const S x = evaluate<S>(scene.rigid_bodies[0].directors[0][0]);
  EXPECT_GT(magnitude(S(x - S(1) / 2)), S(1) / 1000);
  EXPECT_LT(evaluate<S>(scene.rigid_bodies[0].angular_velocity[0]), 19);
}

/// One coordinate of a body, and its velocity.
TYPED_TEST(Hold, KeepsACoordinate) {
  using S = TypeParam;
  const std::string text =
      "dimension = 2\n[[point]]\nname = \"O\"\nposition = [0, 0]\n[[body]]\nname = \"a\"\nmass = 1\n"
      "position = [0.6, 0.7]\nvelocity = [2, 0]\n" +
      rod("O", "a", "1");
  const Scene scene = this->projected(text, {"a.x", "a.vx"});
  EXPECT_EQ(scene.bodies[0].position[0].text(), "0.6");
  this->expect_near(scene.bodies[0].position[1], literal<S>("0.8"), "y");
  EXPECT_EQ(scene.bodies[0].velocity[0].text(), "2");
  this->expect_near(scene.bodies[0].velocity[1], literal<S>("-1.5"), "vy");
}

/// Directors that stand apart are put right, and the body turns on at its rate.
TYPED_TEST(Hold, KeepsARateWhereTheDirectorsMove) {
  const std::string text =
      changed(std::string(rough_sketch), "orientation = \"pi/3\"", "directors = [[0.5, 0.9], [-0.9, 0.5]]");
  const Scene scene = this->projected(text, {"crank.rate"});
  EXPECT_EQ(scene.rigid_bodies[0].angular_velocity[0].text(), "20");
}

TYPED_TEST(Hold, IsRefusedWhereTheConstraintsDecide) {
  const auto message = [&](const std::string& text, const std::vector<std::string>& names) {
    return message_of([&] { this->projected(text, names); });
  };
  expect_words(message(rough_sketch, {"crank.angle", "slider.position"}), {"test.toml: no consistent position"});
  expect_words(message(rough_sketch, {"slider.velocity", "crank.rate"}),
               {"test.toml: the velocities that are held contradict "});
}

TEST(HeldParts, AreThoseOfBodiesByTheirNames) {
  const Scene scene = read_scene(rough_sketch, "test.toml");
  const std::vector<HeldPart> held =
      held_parts(scene, {"slider.velocity", "slider.y", "crank.angle", "rod.rate", "rod.vx"});
  EXPECT_EQ(held[0].velocities, (std::vector<Index>{0, 1}));
  EXPECT_EQ(held[1].positions, std::vector<Index>{1});
  EXPECT_EQ(held[2].positions, (std::vector<Index>{2, 3, 4, 5}));
  EXPECT_EQ(held[3].velocities, (std::vector<Index>{8, 9, 10, 11}));
  EXPECT_EQ(held[3].turning, "rod");
  EXPECT_EQ(held[4].velocities, std::vector<Index>{6});
  const auto message = [&](const char* name) { return message_of([&] { held_parts(scene, {name}); }); };
  expect_words(message("crank.angel"), {"did you mean 'crank.angle'"});
  expect_words(message("crank.position"), {"'crank.position' is nothing that can be held"});
  expect_words(message("T"), {"angle and rate"});
}

}  // namespace
}  // namespace hbvm::core
