#include "run/shadow.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "integrate/runs.hpp"
#include "run/scene_run.hpp"
#include "runs/request_of.hpp"
#include "scalar/literal.hpp"
#include "scalar/text.hpp"
#include "scalar/with_scalar.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

hbvm::Run shadowed_result_of(const Scene& scene, const char* method, const char* step, const char* until,
                             const char* precision) {
  RunRequest request = request_of(scene, method, step, until, precision);
  request.shadow = true;
  return run(request, {});
}

/// Digits by a run with 40 more, kept as a whole.
struct Truth {
  std::vector<Snapshot<Mpfr>> seen;
  Truth(const Scene& scene, int k, int s, const char* step, const char* until) {
    SceneRun<Mpfr> exact(scene, k, s, step, until, SolverKind::automatic);
    Recorder<Mpfr> recorder;
    exact({&recorder});
    seen = recorder.seen;
  }
  double digits(bool of_q, Index i, const Mpfr& value) const {
    Mpfr scale = 0;
    for (const auto& s : seen) raise_to(scale, magnitude(of_q ? s.q[i] : s.p[i]));
    const Mpfr& exact = of_q ? seen.back().q[i] : seen.back().p[i];
    const Mpfr error = magnitude(Mpfr(value - exact));
    return -approximately(Mpfr(log10(Mpfr(error / scale))));
  }
};

/// The numbers themselves: their texts are rounded.
std::vector<BigFloat> numbers(const std::vector<std::string>& texts, const char* precision) {
  return with_scalar(Precision::parse(precision), [&]<Scalar S>() {
    std::vector<BigFloat> result;
    for (const std::string& text : texts) result.push_back(exactly(literal<S>(text)));
    return result;
  });
}

void expect_truth(const char* name, const char* step, const char* until, const char* precision) {
  const Scene scene = load_scene(name);
  const hbvm::Run result = shadowed_result_of(scene, "hbvm:3,3", step, until, precision);
  ASSERT_TRUE(result.shadow && result.shadow->failure.empty());
  const auto q = numbers(result.q, precision), p = numbers(result.p, precision);
  const PrecisionScope more(Precision::parse(precision).digits() + 40);
  const Truth truth(scene, 3, 3, step, until);
  double least = 1000;
  const auto compare = [&](bool of_q, const std::vector<BigFloat>& values, const std::vector<double>& digits) {
    ASSERT_EQ(digits.size(), values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double exact = truth.digits(of_q, static_cast<Index>(i), rounded_to<Mpfr>(raw(values[i])));
      EXPECT_NEAR(digits[i], exact, std::log10(3)) << name << " " << i;
      least = std::min(least, digits[i]);
    }
  };
  compare(true, q, result.shadow->q);
  compare(false, p, result.shadow->p);
  EXPECT_LE(result.shadow->worst.digits, least);
  EXPECT_GT(result.shadow->worst.digits, least - 3);
}

TEST(Shadow, SaysHowManyDigitsSurvivedWithinAFactorOf3) {
  expect_truth("double_pendulum", "1/16", "20", "double");
  expect_truth("charged_double_pendulum", "1/16", "5", "quad");
  expect_truth("triple_pendulum", "1/16", "3", "mpfr:30");
}

TEST(Shadow, IsNamed) {
  const Scene scene = load_scene("kepler");
  for (const auto& [precision, shadow] : {std::pair("double", "mpfr:32"), {"quad", "mpfr:50"}, {"mpfr:70", "mpfr:86"}})
    EXPECT_EQ(shadowed_result_of(scene, "hbvm:2,2", "1/8", "1/4", precision).shadow->precision, shadow);
}

TEST(Shadow, OfWhatRoundingDoesNotTouchHasAllDigits) {
  // A free body whose every position is a number of the precision.
  const Scene scene = read_scene(
      "dimension = 2\nbody = [{name = \"b\", mass = 2, position = [1, 2], velocity = [1, \"1/2\"]}]\n", "free");
  const Shadow shadow = *shadowed_result_of(scene, "hbvm:2,2", "1/8", "4", "double").shadow;
  for (const auto& digits : {shadow.q, shadow.p})
    for (const double d : digits) EXPECT_NEAR(d, 53 * std::log10(2), 1e-12);
}

/// The start is rounded, too: a third of the pendulum's length away from the pivot keeps no more than its digits.
TEST(Shadow, StartsFromTheExactScene) {
  const Scene scene = read_scene(
      "dimension = 2\nbody = [{name = \"b\", mass = 1, position = [\"10^6+1/3\", 1], velocity = [0, 1]}]\n", "third");
  const Shadow shadow = *shadowed_result_of(scene, "hbvm:1,1", "1/8", "1", "double").shadow;
  const double rounding =
      std::log10((1e6 + 1.0 / 3) / std::abs(approximately(Quad(literal<Quad>("10^6+1/3") - Quad(1e6 + 1.0 / 3)))));
  EXPECT_NEAR(shadow.q[0], rounding, 0.01);
}

/// Free, so that many steps are quick: the path is then seen at some points, the end always.
TEST(ShadowedRun, OfManyStepsIsComparedAtSome) {
  const Scene scene =
      read_scene("dimension = 2\nbody = [{name = \"b\", mass = 1, position = [0, 0], velocity = [1, 1]}]\n", "free");
  const Assembled<double> start = assemble<double>(scene);
  const auto shadow_of = [&](long steps, long numbers) {
    ShadowedRun<double> run(2, steps, numbers);
    for (long n = 0; n <= steps; ++n) {
      Vector<double> q = start.q0;
      q[0] = n == steps ? 100 : q[0] + double(n) / 1000;  // right but for the end
      q[1] = double(n) / 1000;
      run.observe({n, 0, q, start.p0, {}});
    }
    const RunRequest request =
        request_of(scene, "hbvm:1,1", "1/1000", std::to_string(steps) + "/1000", "double", SolverKind::fixed_point);
    return run.compare(request, *request.method, {});
  };
  for (const auto& [numbers, every] :
       {std::pair(ShadowedRun<double>::most_numbers, 1L), {400L, 11L}, {40L, 101L}, {1L, 1001L}}) {
    const Shadow shadow = shadow_of(1000, numbers);
    EXPECT_EQ(shadow.every, every);
    EXPECT_GT(shadow.q[1], 14);
    EXPECT_EQ(shadow.worst.component, "q_1");
    EXPECT_EQ(shadow.worst.t, "1.000e+00");
  }
}

TEST(ShadowText, NamesTheWorstOrTheFailure) {
  Shadow shadow{"mpfr:32", {}, {}, {"p_3", "1e+00", 3.14159}, 1, ""};
  EXPECT_EQ(to_text(shadow),
            "shadow\n  against mpfr:32, compared at every step: p_3 kept the fewest digits, 3.1 at t = 1e+00\n");
  shadow.every = 7;
  expect_words(to_text(shadow), {"every 7 steps"});
  shadow.failure = "no";
  EXPECT_EQ(to_text(shadow), "shadow\n  mpfr:32 failed: no\n");
}

}  // namespace
}  // namespace hbvm::core
