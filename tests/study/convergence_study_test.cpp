#include "study/convergence_study.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "hbvm/error.hpp"
#include "runs/request_of.hpp"
#include "scalar/literal.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

ConvergenceWork work_of(const std::string& scene, const std::vector<const char*>& methods, const char* steps,
                        const std::vector<const char*>& precisions = {"mpfr:40"}) {
  ConvergenceWork work{request_of(load_scene(scene), "rattle", "1", "1"),
                       named_methods({methods.begin(), methods.end()}),
                       {},
                       halved_steps(steps, {})};
  for (const char* const precision : precisions) work.precisions.push_back(Precision::parse(precision));
  return work;
}

/// With constraints: the output state's p and lambda have the order of q, the propagated ones that of the paper.
TEST(ConvergenceStudy, FindsTheOrdersOfThePaper) {
  ConvergenceWork work = work_of("double_pendulum", {"hbvm:4,2", "rattle", "radau:2+project"}, "1/8:1/256");
  const int expected[3][3] = {{4, 4, 4}, {2, 2, 2}, {3, 3, 3}}, carried[3] = {4, 2, 1};
  const std::vector<MeasuredConvergence> measured = measure_convergence(work);
  for (std::size_t m = 0; m < measured.size(); ++m)
    for (std::size_t part = 0; part < 3; ++part) {
      ASSERT_TRUE(measured[m].rates[part]) << measured[m].method << part;
      EXPECT_NEAR(measured[m].rates[part]->value, expected[m][part], 0.1) << measured[m].method << part;
      EXPECT_LE(std::abs(measured[m].rates[part]->value - expected[m][part]), measured[m].rates[part]->uncertainty);
    }
  work.methods = named_methods({"hbvm:4,2"});
  work.propagated = true;
  const MeasuredConvergence propagated = measure_convergence(work).front();
  for (std::size_t part = 0; part < 3; ++part) EXPECT_NEAR(propagated.rates[part]->value, carried[part], 0.15) << part;
}

/// In double the fine steps of a high order are round-off, which is seen; in more digits they are not.
TEST(ConvergenceStudy, KnowsRoundOff) {
  const std::vector<MeasuredConvergence> measured =
      measure_convergence(work_of("kepler", {"gauss:6"}, "1/8:1/256", {"double", "mpfr:50"}));
  EXPECT_FALSE(measured[0].rungs[0].back().is_clean());
  EXPECT_TRUE(measured[0].rungs[0].front().is_clean());
  EXPECT_TRUE(measured[1].rungs[0].back().is_clean());
  EXPECT_FALSE(measured[0].rates[0]);
  EXPECT_NEAR(measured[1].rates[0]->value, 12, 0.2);
  EXPECT_TRUE(measured[1].rungs[2].empty());
  EXPECT_EQ(measured[1].steps.size(), 6u);
}

TEST(ConvergenceStudy, TellsOfStepsThatCannotBeMade) {
  ConvergenceWork work = work_of("double_pendulum", {"rattle"}, "2:1/64", {"double"});
  work.request.until = Expression::parse("8");
  const MeasuredConvergence measured = measure_convergence(work).front();
  expect_words(measured.failure, {"step "});
  EXPECT_LT(measured.steps.size(), 8u);
  EXPECT_GT(measured.steps.size(), 3u);
}

TEST(HalvedSteps, LastForAWholeTimeIfTheyCan) {
  EXPECT_EQ(time_of_sixteen(Expression::parse("1/8"), {}).text(), "2");
  EXPECT_EQ(time_of_sixteen(Expression::parse("1/7"), {}).text(), "16*(1/7)");
}

TEST(HalvedSteps, GoFromTheFirstToTheLast) {
  const std::vector<Expression> steps = halved_steps("pi/8:pi/128", {});
  ASSERT_EQ(steps.size(), 5u);
  EXPECT_EQ(steps.front().text(), "pi/8");
  const PrecisionScope digits(30);
  EXPECT_LE(magnitude(Mpfr(evaluate<Mpfr>(steps.back()) - evaluate<Mpfr>(Expression::parse("pi/128")))),
            epsilon<Mpfr>());
  for (const char* const range :
       {"", "1/8", "1/8:", ":1/8", "1/8:1/4", "1/8:1/24", "1/8:1/64", "0:1", "1/8:-1/256", "a:b", "1/8:1/256:1/512"})
    EXPECT_THROW(halved_steps(range, {}), InputError) << range;
}

}  // namespace
}  // namespace hbvm::core
