#include "step/formulation.hpp"

#include "hbvm/error.hpp"
#include "printing.hpp"
#include "problem/state_evaluator.hpp"
#include "step/stepping.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

TEST(Formulations, StandBehindAName) {
  for (const auto& [text, name, kind] : {std::tuple("rk4", "rk4", OnConstraints::drift),
                                         {"a.toml+project", "a.toml", OnConstraints::project},
                                         {"+ggl", "", OnConstraints::ggl},
                                         {"sdirk:3+baumgarte:5,1/2", "sdirk:3", OnConstraints::baumgarte},
                                         {"+projects", "+projects", OnConstraints::drift}}) {
    const FormulatedName read = FormulatedName::parse(text);
    EXPECT_EQ(read.name, name);
    EXPECT_EQ(read.formulation.on_constraints, kind);
    EXPECT_EQ(read.name + read.formulation.suffix(), text);
  }
  EXPECT_EQ(FormulatedName::parse("rk4+baumgarte:5,1/2").formulation.beta.text(), "1/2");
}

TEST(Formulations, OfBaumgarteHaveTwoNumbers) {
  for (const char* const numbers : {"", "5", "5,", ",5", "-1,5", "5,-1", "5,x", "5,5,5", "1/0,1", "1e999999,1"})
    expect_words(message_of([&] { FormulatedName::parse(std::string("rk4+baumgarte:") + numbers); }),
                 {"+baumgarte:", "two numbers", "+baumgarte:5,5"});
}

/// From a start with g' = 0 the equation g'' + 2 alpha g' + alpha^2 g = 0 has the solution
/// g_0 (1 + alpha t) exp(-alpha t). The rod of this pendulum is too long at first.
TEST(Formulations, OfBaumgarteBringGToZeroAtItsRate) {
  const PrecisionScope digits(40);
  Assembled<Mpfr> scene = assemble<Mpfr>(load_scene("simple_pendulum"));
  scene.q0 *= Mpfr(1001) / 1000;
  scene.p0.setZero();
  StateEvaluator<Mpfr> point(scene.problem);
  const Mpfr before = point.constraints(scene.q0)[0];
  const State<Mpfr> end = after("rk4+baumgarte:3,3", scene, Mpfr(1) / 512, 512);
  EXPECT_NEAR(static_cast<double>(Mpfr(point.constraints(end.q)[0] / before)), 4 * std::exp(-3.), 1e-8);
}

/// Each stage fulfils both constraints, and so does the end. Of order 2 or more they have that order, of 4 only 3.
TEST(Formulations, OfGearGuptaAndLeimkuhlerEndOnBothConstraints) {
  const PrecisionScope digits(40);
  const Assembled<Mpfr> scene = assemble<Mpfr>(load_scene("double_pendulum"));
  StateEvaluator<Mpfr> point(scene.problem);
  const State<Mpfr> expected = after("hbvm:12,12", scene, Mpfr(1) / 16, 4);
  for (const auto& [method, order] : {std::pair("euler", 1), {"heun", 2}, {"rk4", 3}, {"dopri5", 3}}) {
    const auto error = [&, name = std::string(method) + "+ggl"](long steps) {
      const State<Mpfr> end = after(name, scene, Mpfr(1) / (4 * steps), steps);
      EXPECT_LE(max_norm(point.constraints(end.q)), 16 * epsilon<Mpfr>()) << name;
      EXPECT_LE(max_norm(point.hidden_constraints(end.q, end.p)), 64 * epsilon<Mpfr>()) << name;
      return distance(end.q, expected.q);
    };
    EXPECT_NEAR(order_of(error(64), error(128)), order, 0.1) << method;
  }
}

TEST(Formulations, OfGearGuptaAndLeimkuhlerTakeSomeMethodsAndForces) {
  const Assembled<double> rods = assemble<double>(load_scene("double_pendulum")),
                          driven = assemble<double>(load_scene("driven_pendulum")),
                          free = assemble<double>(load_scene("kepler"));
  for (const char* const method : {"radau:2+ggl", "sdirk:2+ggl"})
    expect_words(message_of([&] { after(method, rods, 1. / 16, 1); }), {"+ggl takes an explicit method"});
  EXPECT_NE(message_of([&] { after("rk4+ggl", driven, 1. / 16, 1); }), "");
  EXPECT_EQ(after("rk4+ggl", free, 1. / 16, 4).q, after("rk4", free, 1. / 16, 4).q);
}

}  // namespace
}  // namespace hbvm::core
