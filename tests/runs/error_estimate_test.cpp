#include "run/error_estimate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "run/scene_run.hpp"
#include "runs/request_of.hpp"
#include "scalar/literal.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

/// A run whose error is asked for.
RunRequest assessed(const std::string& scene, const char* method, const char* step, const char* until,
                    const char* precision) {
  RunRequest request = request_of(load_scene(scene), method, step, until, precision);
  request.error = true;
  return request;
}

double digits_of(const std::string& number, const std::string& exact) {
  const Mpfr x = literal<Mpfr>(number), y = literal<Mpfr>(exact);
  return x == y ? 100 : -approximately(Mpfr(log10(magnitude(Mpfr((x - y) / y)))));
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// Digits by a run of another method, with far smaller steps: none is promised that is not there, and not much less.
TEST(ErrorEstimate, PromisesTheDigitsThatAreRight) {
  const PrecisionScope digits(60);
  struct Case {
    const char *scene, *method, *step, *precision;
  };
  for (const Case& c : {Case{"modified_pendulum", "hbvm:4,2", "1/16", "mpfr:40"},
                        {"modified_pendulum", "hbvm:4,2", "1/16", "double"},
                        {"tethered_satellites", "rattle", "1/32", "double"},
                        {"double_pendulum", "hbvm:auto,3", "1/16", "quad"},
                        {"heavy_top", "lobatto:3", "1/16", "double"},
                        {"kepler", "hbvm:3,3", "1/8", "double"}}) {
    const hbvm::Run found = run(assessed(c.scene, c.method, c.step, "2", c.precision), {}),
                    exact = run(request_of(load_scene(c.scene), "hbvm:20,20", "1/16", "2", "mpfr:60"), {});
    ASSERT_TRUE(found.error);
    const ErrorEstimate& error = *found.error;
    EXPECT_EQ(error.failure, "");
    ASSERT_EQ(error.q_digits.size(), found.q.size());
    ASSERT_EQ(error.p_digits.size(), found.q.size());
    ASSERT_EQ(error.lambda_digits.size(), found.lambda.size());
    std::vector<double> promises, all_right;
    const auto compare = [&](const std::vector<std::string>& numbers, const std::vector<std::string>& truth,
                             const std::vector<double>& promised, const char* what) {
      for (std::size_t i = 0; i < numbers.size(); ++i) {
        // By its symmetry this motion does not leave a plane: what is found there is rounding.
        if (magnitude(literal<Mpfr>(truth[i])) < literal<Mpfr>("1e-20")) continue;
        const double right = digits_of(numbers[i], truth[i]);
        EXPECT_LE(promised[i], right + 0.3) << c.scene << ' ' << c.method << ' ' << what << i;
        promises.push_back(promised[i]);
        all_right.push_back(right);
      }
    };
    compare(found.q, exact.q, error.q_digits, "q");
    compare(found.output_p, exact.output_p, error.p_digits, "p");
    compare(found.output_lambda, exact.output_lambda, error.lambda_digits, "lambda");
    EXPECT_GE(median(promises), std::min(median(all_right), 15.0) - 1.5) << c.scene << ' ' << c.method;
  }
}

/// The run beside finds the same errors.
TEST(ErrorEstimate, TakesTheStoredReferenceIfThereIsOne) {
  const PrecisionScope digits(60);
  for (const char* scene : {"modified_pendulum", "double_physical_pendulum", "heavy_top", "four_bar_linkage", "kepler"})
    for (const char* precision : {"double", "mpfr:40"}) {
      RunRequest request = assessed(scene, "hbvm:4,2", "1/32", "20/2", precision);
      request.scene.name = "another name";
      const ErrorEstimate stored = *run(request, {}).error;
      EXPECT_TRUE(stored.reference.starts_with("stored reference, 50 digits")) << stored.reference;
      EXPECT_EQ(stored.method + stored.precision, "");
      // The same motion by another text of the scene.
      request.scene.constants.emplace("unused", Expression::parse("1"));
      const ErrorEstimate computed = *run(request, {}).error;
      EXPECT_EQ(computed.reference, "computed now");
      EXPECT_NE(computed.method, "");
      const auto compare = [&](const std::vector<double>& a, const std::vector<double>& b, const char* what) {
        ASSERT_EQ(a.size(), b.size());
        for (std::size_t i = 0; i < a.size(); ++i)
          EXPECT_NEAR(a[i], b[i], 0.1) << scene << ' ' << precision << ' ' << what << i;
      };
      compare(stored.q_digits, computed.q_digits, "q");
      compare(stored.p_digits, computed.p_digits, "p");
      compare(stored.lambda_digits, computed.lambda_digits, "lambda");
      EXPECT_NEAR(std::stod(stored.q) / std::stod(computed.q), 1, 0.02);
      EXPECT_EQ(stored.lambda.empty(), computed.lambda.empty());
    }
}

/// One of too few digits, another time, another start and another direction.
TEST(ErrorEstimate, LeavesAStoredReferenceThatDoesNotTell) {
  const auto against = [](const char* method, const char* step, const char* until, const char* precision,
                          Direction direction = Direction::forward) {
    RunRequest request = assessed("modified_pendulum", method, step, until, precision);
    request.direction = direction;
    return run(request, {}).error->reference;
  };
  EXPECT_EQ(against("hbvm:8,8", "1/16", "10", "mpfr:70"), "stored reference, 50 digits, proved");
  EXPECT_EQ(against("hbvm:24,24", "1/16", "10", "mpfr:70"), "computed now");
  EXPECT_EQ(against("hbvm:24,24", "1/16", "20", "mpfr:70"), "stored reference, 100 digits, proved");
  EXPECT_EQ(against("hbvm:4,4", "1/16", "10", "double", Direction::backward), "computed now");
  EXPECT_EQ(against("hbvm:4,4", "1/16", "161/16", "double"), "computed now");
}

}  // namespace
}  // namespace hbvm::core
