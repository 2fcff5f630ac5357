#include "step/radau_method.hpp"

#include "hbvm/error.hpp"
#include "printing.hpp"
#include "step/stepping.hpp"

namespace hbvm::core {
namespace {

TEST(RadauMethods, SayWhatTheyAre) {
  const MethodPtr plain = radau_method("3"), projected = radau_method("3+project");
  EXPECT_EQ(plain->text(), "radau:3");
  EXPECT_EQ(projected->text(), "radau:3+project");
  EXPECT_EQ(plain->title(), "Radau IIA(3)");
  EXPECT_EQ(projected->title(), "Radau IIA(3), projected");
  EXPECT_EQ(plain->order(), 5);
  EXPECT_EQ(plain->stages(), 3);
  EXPECT_EQ(plain->terms(), 3);
  EXPECT_EQ(plain->parameters().at("s").text(), "3");
  EXPECT_FALSE(plain->kept().constraints || plain->kept().energy || plain->kept().momenta || plain->kept().reversal);
  EXPECT_TRUE(projected->kept().constraints && projected->kept().hidden);
  for (const char* const arguments : {"", "0", "-1", "201", "3x", "3+", "+project", "1.5"})
    EXPECT_THROW(radau_method(arguments), InputError) << arguments;
}

/// The error at a fixed time falls by 2^(2s - 1), with constraints and without.
TEST(RadauMethods, HaveOrder2sMinus1) {
  const PrecisionScope digits(60);
  for (const std::string name : {"kepler", "double_pendulum"}) {
    const Assembled<Mpfr> scene = assemble<Mpfr>(load_scene(name));
    const State<Mpfr> expected = after("hbvm:16,16", scene, Mpfr(1) / 32, 8);
    for (const int s : {1, 2, 3, 4}) {
      const std::string method = "radau:" + std::to_string(s) + (name == "kepler" ? "" : "+project");
      const auto error = [&](long steps) {
        return distance(after(method, scene, Mpfr(1) / (4 * steps), steps).q, expected.q);
      };
      EXPECT_NEAR(order_of(error(32), error(64)), 2 * s - 1, 0.2) << name << " " << method;
    }
  }
}

/// Of one stage it is the implicit Euler method: q_1 = q_0 + h p_1 and p_1 = p_0 + h f(q_1).
TEST(RadauMethods, OfOneStageIsImplicitEuler) {
  const PrecisionScope digits(40);
  const Assembled<Quad> scene = assemble<Quad>(load_scene("kepler"));
  const Quad h = Quad(1) / 64;
  const State<Quad> state = after("radau:1", scene, h, 1);
  const Quad r = sqrt(Quad(state.q[0] * state.q[0] + state.q[1] * state.q[1]));
  EXPECT_LE(distance(state.q, Vector<Quad>(scene.q0 + h * state.p)), 16 * epsilon<Quad>());
  EXPECT_LE(distance(state.p, Vector<Quad>(scene.p0 - h / (r * r * r) * state.q)), 16 * epsilon<Quad>());
}

}  // namespace
}  // namespace hbvm::core
