#include "hard_cases/measure.hpp"

#include <gtest/gtest.h>

#include "hard_cases/motion.hpp"
#include "hard_cases/scenes.hpp"

namespace hbvm::core {
namespace {

RunRequest request(Scene scene, const char* method, const char* precision, const char* step = "1/32",
                   const char* until = "1") {
  return request_of(std::move(scene), method, "paper", step, until, precision);
}

TEST(Accuracy, HoldsWhereNothingIsHard) {
  for (const char* const precision : {"double", "quad", "mpfr:30"})
    for (const char* const scene : {"kepler", "double_pendulum"}) {
      const CaseResult result = accuracy(request(load_scene(scene), "hbvm:4,2", precision));
      EXPECT_EQ(result.failure, "");
      ASSERT_EQ(result.criteria.size(), 1u);
      EXPECT_TRUE(result.criteria[0].holds()) << scene << precision << result.criteria[0].value;
      EXPECT_GT(result.criteria[0].value, 0) << "round-off shows";
    }
}

/// One coordinate wrong in its last digits is found, however small it is beside the others.
TEST(Accuracy, SeesOneWrongCoordinate) {
  const RunRequest run = request(beside_kepler("1e-12"), "hbvm:4,2", "double", "2*pi/64", "pi");
  RunRequest more = run;
  more.precision = Precision::parse("mpfr:40");
  const SampledMotion exact = motion_of(more), kicked = motion_of(more, {52, false});
  ASSERT_TRUE(compared(run, motion_of(run), exact, kicked).criteria[0].holds());
  for (std::size_t i = 0; i < 4; ++i)
    for (const auto part : {&ExactState::q, &ExactState::p}) {
      SampledMotion wrong = motion_of(run);
      BigFloat& x = (wrong.samples.back().*part)[i];
      const BigFloat& scale = (exact.scale.*part)[i];
      if (mpfr_zero_p(raw(scale)) != 0) continue;
      BigFloat error = scale;
      mpfr_mul_2si(raw(error), raw(error), -30, MPFR_RNDN);
      mpfr_add(raw(x), raw(x), raw(error), MPFR_RNDN);
      const CaseResult result = compared(run, wrong, exact, kicked);
      EXPECT_FALSE(result.criteria[0].holds()) << i;
      EXPECT_EQ(result.message.back(), static_cast<char>('1' + i));
    }
}

TEST(Accuracy, AllowsForTheProblemsOwnGrowth) {
  // Upright, an error grows like exp(t): by 1e10 until t = 24.
  const CaseResult result = accuracy(request(near_upright("1e-4"), "hbvm:8,8", "double", "1/4", "24"));
  ASSERT_EQ(result.criteria.size(), 1u) << result.message;
  EXPECT_TRUE(result.criteria[0].holds()) << result.criteria[0].value;
}

TEST(Reversal, SeesTheStartAgain) {
  const CaseResult result = reversal(request(load_scene("double_pendulum"), "hbvm:3,3", "double"));
  ASSERT_EQ(result.criteria.size(), 1u) << result.message;
  EXPECT_TRUE(result.criteria[0].holds()) << result.criteria[0].value;
  const SampledMotion back = motion_of(request(load_scene("double_pendulum"), "hbvm:3,3", "double"), {0, true});
  EXPECT_EQ(back.steps, 64);
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_NEAR(mpfr_get_d(raw(back.samples.back().p[i]), MPFR_RNDN),
                -mpfr_get_d(raw(back.samples.front().p[i]), MPFR_RNDN), 1e-13);
}

TEST(Energy, IsInUnitsOfItsTerms) {
  const CaseResult kept = energy(request(load_scene("kepler"), "hbvm:14,4", "quad"));
  ASSERT_EQ(kept.criteria.size(), 1u) << kept.message;
  EXPECT_TRUE(kept.criteria[0].holds()) << kept.criteria[0].value;
  const CaseResult lost = energy(request(load_scene("kepler"), "hbvm:4,4", "quad"));
  EXPECT_FALSE(lost.criteria.at(0).holds()) << lost.criteria.at(0).value;
}

TEST(Guarded, NamesTheCause) {
  EXPECT_EQ(guarded([]() -> CaseResult { throw InputError("x"); }).failure, "refused");
  EXPECT_EQ(guarded([]() -> CaseResult { throw IntegrationError("x"); }).failure, "integration_error");
  const CaseResult result = accuracy(request(load_scene("double_pendulum"), "hbvm:3,3", "double", "4", "128"));
  EXPECT_EQ(result.failure, "stage_equations_diverge") << result.message;
  EXPECT_THROW(guarded([]() -> CaseResult { throw std::logic_error("a mistake"); }), std::logic_error);
}

}  // namespace
}  // namespace hbvm::core
