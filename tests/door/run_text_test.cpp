#include <gtest/gtest.h>

#include "hbvm/run.hpp"
#include "words.hpp"

namespace hbvm {
namespace {

/// A run whose numbers are made up.
hbvm::Run made_up_run() {
  hbvm::Run run;
  run.scene = "pendulum";
  run.title = "A pendulum";
  run.method = "hbvm:4,2";
  run.precision = "double";
  run.solver = "newton";
  run.step = "1/16";
  run.t = "20";
  run.steps = 320;
  run.q_names = {"bob.x", "bob.y"};
  run.p_names = {"bob.px", "bob.py"};
  run.lambda_names = {"rod pivot-bob"};
  run.q = {"0.123456789", "-0.987654321"};
  run.p = {"1.5", "2.5"};
  run.lambda = {"3.5"};
  run.output_p = {"1.25", "2.25"};
  run.output_lambda = {"3.25"};
  run.output_delta_H = "1e-7";
  run.e_H = "4.4444e-16";
  run.e_g = "2.2222e-16";
  run.e_hid = "1e-5";
  run.health = {"4.5", "3e-16", "1e-6", {}};
  return run;
}

TEST(DoorRunText, BeginsWithTitleAndVerdict) {
  const std::string text = to_text(made_up_run());
  EXPECT_TRUE(text.starts_with(
      "pendulum: A pendulum\n"
      "hbvm:4,2, double, solver newton, 320 steps of 1/16 to t = 20\n"
      "verdict: digits not assessed (--error); H off by 3e-16 of its terms, constraints by 2.22e-16; no warning\n"
      "\ngreatest errors at mesh points\n"
      "  energy                  e_H      4.44e-16   3e-16 of H's greatest term\n"))
      << text;
}

TEST(DoorRunText, TellsTheOutputStateOnceToSixDigits) {
  const std::string text = to_text(made_up_run());
  core::expect_words(text, {"\nstate at t = 20, to 6 digits, not assessed (all: --state)\n",
                            "bob.x       0.123457   1.25000", "rod pivot-bob  3.25000"});
  for (const char* other : {"1.5", "3.5", "0.123456789"}) EXPECT_EQ(text.find(other), std::string::npos) << text;
}

/// Claims are told as they are proved: what is kept, and what is not.
TEST(DoorRunText, TellsWhatIsProved) {
  hbvm::Run run = made_up_run();
  EXPECT_EQ(to_text(run).find("proved"), std::string::npos);
  ProvedSteps& proved = run.proved.emplace();
  proved.steps = 320;
  proved.working_digits = 40;
  proved.growth = 3.25;
  proved.only_within = "1.50e-02";
  proved.q = {"0.1250", "-0.9500"};
  proved.p = {"1.55", "2.55"};
  proved.lambda = {"3.55"};
  proved.lambda_names = {"rod pivot-bob"};
  proved.q_radius = "1.11e-30";
  proved.p_radius = "2.22e-30";
  proved.lambda_radius = "3.33e-30";
  proved.e_H = "4.44e-29";
  proved.e_g = "5.55e-20";
  proved.e_g_least = "5.54e-20";
  proved.off_q = "6.66e-16";
  proved.off_p = "7.77e-16";
  core::expect_words(to_text(run),
                     {"\nproved of the method without rounding\n", "each of 320 steps has a solution",
                      "no other as near as 1.50e-02 of", "H(y_n) = H_0 within 4.44e-29 at all 320 steps\n",
                      "not g(q_n) = 0: it is off by at most 5.55e-20, and at one step by at least 5.54e-20\n",
                      "q is known within 1.11e-30, p within 2.22e-30, lambda within 3.33e-30\n",
                      "at most 6.66e-16 in q, 7.77e-16 in p\n", "10^3.2"});
  EXPECT_EQ(to_text(run).find("0.1250"), std::string::npos);
  core::expect_words(to_text(run, true), {"q without rounding, proved\n  1   bob.x  0.1250\n", "2   bob.py  2.55\n",
                                          "1   rod pivot-bob  3.55\n"});
}

TEST(DoorRunText, TellsAllDigitsOfBothStatesOnDemand) {
  core::expect_words(to_text(made_up_run(), true),
                     {"p, propagated\n  1   bob.px  1.5\n  2   bob.py  2.5\n", "q\n  1   bob.x  0.123456789\n",
                      "lambda, of the last step\n  1   rod pivot-bob  3.5\n", "1   bob.px  1.25\n",
                      "lambda of the output state\n  1   rod pivot-bob  3.25\n"});
}

TEST(DoorRunText, TellsTheDigitsThatAreRight) {
  hbvm::Run run = made_up_run();
  run.error = ErrorEstimate{"computed now", "taylor", "mpfr:32", "1e-5", "2e-2", "0.5", {4.9, 12}, {2, 0.3}, {3.1}, {}};
  const std::string text = to_text(run);
  core::expect_words(text, {"verdict: q right to 1e-5, p to 2e-2, lambda to 0.5; ",
                            "state at t = 20, to the digits that are right, against taylor, mpfr:32, computed now\n",
                            "bob.x       0.1235           4.9     1.2  2.0\n", "-0.987654321000  12.0    ?    0.3"});
  core::expect_words(to_text(run, true), {"0.123456789   4.9 digits\n", "3.25  3.1 digits\n"});
}

TEST(DoorRunText, SaysWhyTheDigitsAreUnknown) {
  hbvm::Run run = made_up_run();
  run.error = ErrorEstimate{};
  run.error->method = "taylor";
  run.error->precision = "mpfr:32";
  run.error->failure = "no step";
  core::expect_words(to_text(run), {"verdict: digits unknown; ", "taylor, mpfr:32 failed: no step\n"});
}

TEST(DoorRunText, CountsWarningsAndExplainsThem) {
  hbvm::Run run = made_up_run();
  run.health.warnings = {{"energy_lost", "a"}, {"step_too_large", "b"}};
  core::expect_words(to_text(run), {"; 2 warnings: energy_lost, step_too_large\n",
                                    "\nWARNING energy_lost: a\nWARNING step_too_large: b\n"});
}

/// The table ends, and says so; the whole state does not.
TEST(DoorRunText, CutsALongState) {
  hbvm::Run run = made_up_run();
  constexpr int n = 30;
  run.q_names.clear();
  for (int i = 1; i <= n; ++i) run.q_names.push_back("b" + std::to_string(i));
  run.p_names = run.q_names;
  run.q = run.p = run.output_p = std::vector<std::string>(n, "0.5");
  const std::string text = to_text(run);
  core::expect_words(text, {"  24  b24", "\n  ... and 6 more (--state)\n"});
  EXPECT_EQ(text.find("b25"), std::string::npos);
  core::expect_words(to_text(run, true), {"  30  b30"});
}

/// Without constraints there is one p.
TEST(DoorRunText, OfAFreeMotionHasNoMultipliers) {
  const hbvm::Run run = hbvm::run({.scene = load_scene("kepler"), .method = "hbvm:2,2", .step = "1/16", .until = 1});
  EXPECT_EQ(to_text(run).find("lambda"), std::string::npos) << to_text(run);
  core::expect_words(to_text(run, true), {run.q[0].c_str(), run.p[0].c_str(), "\np\n"});
}

}  // namespace
}  // namespace hbvm
