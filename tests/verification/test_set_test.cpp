#include <gtest/gtest.h>

#include "printing.hpp"
#include "problem/problem.hpp"
#include "reference/store.hpp"
#include "reference/taylor.hpp"
#include "scalar/literal.hpp"
#include "scene/assemble.hpp"

namespace hbvm::core {
namespace {

/// The references of the field's test problems against what is known of them besides.
class TestSet : public ::testing::Test {
 protected:
  PrecisionScope digits{60};

  static Reference stored(const std::string& name) {
    for (const auto& [known, text] : shipped_references())
      if (known == name) return read_reference(text, known).reference;
    ADD_FAILURE() << "no reference " << name;
    return {};
  }
  static Mpfr number(const std::string& text) { return literal<Mpfr>(text); }
};

TEST_F(TestSet, HasTenTimesOfFiftyDigitsByTwoRoutes) {
  for (const char* const name :
       {"car_axis_t3_50", "andrews_squeezer_t0_03_50", "heavy_top_150_t2_50", "slider_crank_t0_1_50",
        "four_bars_2_t10_50", "four_bars_10_t10_50", "bricard_t10_50", "fekete_t100_50", "flyball_governor_t0_1_50",
        "closed_chain_t5_50", "unequal_double_pendulum_t10_50"}) {
    const Reference reference = stored(name);
    EXPECT_EQ(reference.times.size(), 10u) << name;
    EXPECT_GE(reference.routes.size(), 2u) << name;
    for (const ReferenceState& state : reference.times) EXPECT_GT(state.agreed, 50) << name;
  }
}

/// The first of the ten times is found again with fewer digits: the scenes are those of the references.
TEST_F(TestSet, FirstTimesAreFoundAgain) {
  constexpr int few = 20;
  for (const char* const name : {"car_axis_t3_50", "andrews_squeezer_t0_03_50", "heavy_top_150_t2_50",
                                 "slider_crank_t0_1_50", "four_bars_2_t10_50", "bricard_t10_50", "closed_chain_t5_50",
                                 "flyball_governor_t0_1_50", "unequal_double_pendulum_t10_50"}) {
    const Reference reference = stored(name);
    const ReferenceState& first = reference.times.front();
    const PrecisionScope scope(few + 10);
    const Assembled<Mpfr> scene = assemble<Mpfr>(load_scene(reference.scene));
    TaylorMotion motion(scene.problem, scene.q0, scene.p0);
    motion.advance_to(number(first.t));
    const Mpfr unit = number("1e-20");
    for (std::size_t i = 0; i < first.q.size(); ++i)
      EXPECT_LE(magnitude(Mpfr(motion.q()[static_cast<Index>(i)] - number(first.q[i]))), unit) << name << ", q_" << i;
  }
}

/// The end states that the Test Set for IVP Solvers (Mazzia and Magherini, 2008) publishes. Of the car axis 12 digits
/// are right, of Andrews' squeezer nine.
TEST_F(TestSet, EndsAsPublished) {
  const ReferenceState car = stored("car_axis_t3_50").times.back();
  const std::vector<std::string> published{"0.0493455784275402809122", "0.496989460230171153861",
                                           "1.04174252488542151681", "0.373911027265361256927"};
  for (std::size_t i = 0; i < published.size(); ++i)
    EXPECT_LE(magnitude(Mpfr(number(car.q[i]) - number(published[i]))), number("1e-12")) << i;
  EXPECT_LE(magnitude(Mpfr(number(car.lambda[1]) - number("0.00110468033125734368808"))), number("1e-12"));

  const Reference andrews = stored("andrews_squeezer_t0_03_50");
  EXPECT_EQ(andrews.observed_names,
            (std::vector<std::string>{"beta", "Theta", "gamma", "phi", "delta", "Omega", "epsilon"}));
  const std::vector<std::string> angles{"15.81077119629904",   "-15.75637105984298", "0.04082224013073101",
                                        "-0.5347301163226948", "0.5244099658805304", "0.5347301163226948",
                                        "1.048080741042263"};
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const Mpfr theirs = number(angles[i]), ours = number(andrews.times.back().observed[i]);
    EXPECT_LE(magnitude(Mpfr(ours - theirs)), number("3e-10") * magnitude(theirs)) << andrews.observed_names[i];
    EXPECT_GE(magnitude(Mpfr(ours - theirs)), number("1e-13") * magnitude(theirs)) << andrews.observed_names[i];
  }
}

/// Nothing turns the governor about its shaft, whatever its springs and dampers do: sum of x p_y - y p_x over bodies
/// and directors. The others lose no energy.
TEST_F(TestSet, KeepsWhatNothingChanges) {
  const Reference governor = stored("flyball_governor_t0_1_50");
  const auto spin = [](const ReferenceState& state) {
    Mpfr sum = 0;
    for (std::size_t i = 0; i + 2 < state.q.size(); i += 3)
      sum += number(state.q[i]) * number(state.p[i + 1]) - number(state.q[i + 1]) * number(state.p[i]);
    return sum;
  };
  const Mpfr first = spin(governor.times.front()), last = spin(governor.times.back());
  EXPECT_GT(first, 1);
  EXPECT_LE(magnitude(Mpfr(last - first)), number("1e-46"));
  EXPECT_GE(magnitude(Mpfr(number(governor.times.back().H) - number(governor.times.front().H))), number("1e-4"));
  for (const char* const name : {"closed_chain_t5_50", "unequal_double_pendulum_t10_50"}) {
    const Reference kept = stored(name);
    const Mpfr H = number(kept.times.front().H);
    for (const ReferenceState& state : kept.times)
      EXPECT_LE(magnitude(Mpfr(number(state.H) - H)), number("1e-46")) << name << " at " << state.t;
  }
}

/// The crank turns as it is said to, and the slider is where the triangle of the two bars has it.
TEST_F(TestSet, SliderIsWhereTheTriangleHasIt) {
  const Mpfr l1 = number("0.15"), l2 = number("0.3");
  for (const ReferenceState& state : stored("slider_crank_t0_1_50").times) {
    const Mpfr angle = 150 * number(state.t);
    const Mpfr x = l1 * cos(angle) + sqrt(Mpfr(l2 * l2 - l1 * l1 * sin(angle) * sin(angle)));
    EXPECT_LE(magnitude(Mpfr(number(state.q[0]) - x)), number("1e-50")) << state.t;
  }
}

/// N windows of bars that stay parallel are one pendulum. Each bar has mass 1 and length 1. So its moment of inertia is
/// N/3 + 1/3 + N, and that of its weight g (N/2 + 1/2 + N) times the cosine of the angle.
TEST_F(TestSet, FourBarsAreOnePendulum) {
  for (const int windows : {2, 10}) {
    const Mpfr inertia = Mpfr(windows + 1) / 3 + windows, moment = Mpfr(windows + 1) / 2 + windows;
    const std::string length = std::to_string(2 * (4 * windows + 1)) + "/" + std::to_string(3 * (3 * windows + 1));
    ASSERT_LE(magnitude(Mpfr(inertia / moment - evaluate<Mpfr>(Expression::parse(length)))), number("1e-55"));
    const Assembled<Mpfr> pendulum = assemble<Mpfr>(read_scene(R"(title = "pendulum"
dimension = 2
point = [{ name = "o", position = [0, 0] }]
body = [{ name = "b", mass = 1, position = [0, ")" + length + R"("], velocity = [")" +
                                                                   length + R"(", 0] }]
constraint = [{ kind = "rod", between = ["o", "b"], length = ")" + length +
                                                                   R"(" }]
effect = [{ kind = "uniform_gravity", acceleration = [0, -9.81] }]
)",
                                                               "pendulum"));
    TaylorMotion motion(pendulum.problem, pendulum.q0, pendulum.p0);
    const Mpfr l = evaluate<Mpfr>(Expression::parse(length));
    const Reference reference = stored("four_bars_" + std::to_string(windows) + "_t10_50");
    for (const ReferenceState& state : reference.times) {
      motion.advance_to(number(state.t));
      // The first director of the first bar.
      EXPECT_LE(magnitude(Mpfr(motion.q()[0] / l - number(state.q[0]))), number("1e-50")) << state.t;
      EXPECT_LE(magnitude(Mpfr(motion.q()[1] / l - number(state.q[1]))), number("1e-50")) << state.t;
    }
  }
}

}  // namespace
}  // namespace hbvm::core
