#include "scene/set_number.hpp"

#include <gtest/gtest.h>

#include "hbvm/error.hpp"
#include "printing.hpp"
#include "scene/assemble.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

Expression number(const char* text) { return Expression::parse(text); }

/// A constant, and all that is made of it: the satellites start elsewhere, and still fly by with H = 0.
TEST(SetNumber, ChangesAConstantAndWhatFollows) {
  const PrecisionScope digits(30);
  const Scene scene = load_scene("tethered_satellites"), changed = with_number(scene, "z0", number("101/5"));
  const Assembled<Mpfr> before = assemble<Mpfr>(scene), after = assemble<Mpfr>(changed);
  EXPECT_LE(magnitude(Mpfr(5 * (after.q0[2] - before.q0[2]) - 1)), 1'000 * epsilon<Mpfr>());
  EXPECT_NE(after.p0, before.p0);
  EXPECT_EQ(changed.name, scene.name);
  EXPECT_EQ(settings_in_command(scene), "");
  EXPECT_EQ(settings_in_command(with_number(changed, "z0", number("22"))), " --set 'z0=101/5' --set 'z0=22'");
}

TEST(SetNumber, ChangesMassesAndCharges) {
  const Scene pendulum = with_number(load_scene("double_pendulum"), "a.mass", number("7/3"));
  EXPECT_EQ(pendulum.bodies[0].mass->text(), "7/3");
  EXPECT_EQ(load_scene("heavy_top").rigid_bodies.size(), 1u);
  const std::string top = load_scene("heavy_top").rigid_bodies[0].name;
  EXPECT_EQ(with_number(load_scene("heavy_top"), top + ".mass", number("2")).rigid_bodies[0].mass.text(), "2");
  const Scene charged = load_scene("charged_double_pendulum");
  for (const SceneBody& body : charged.bodies) {
    if (body.charge) {
      EXPECT_NE(write_scene(with_number(charged, body.name + ".charge", number("1/7"))), write_scene(charged));
    }
  }
}

TEST(SetNumber, RefusesWhatThereIsNot) {
  const auto refusal = [](const char* scene, const char* what, const char* value) {
    return message_of([&] { with_number(load_scene(scene), what, number(value)); });
  };
  expect_words(refusal("tethered_satellites", "z1", "2"), {"'z1'", "did you mean 'z0'?"});
  expect_words(refusal("double_pendulum", "c.mass", "2"), {"'c.mass'", "a.mass", "b.mass"});
  expect_words(refusal("double_pendulum", "a.height", "2"), {"'a.height'"});
}

}  // namespace
}  // namespace hbvm::core
