#include "run/proved_run.hpp"

#include "printing.hpp"
#include "request_of.hpp"
#include "run/scene_run.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

RunRequest to_prove(const std::string& method, const std::string& precision = "double") {
  RunRequest request = request_of(load_scene("double_pendulum"), method, "1/10", "1", precision);
  request.prove = true;
  return request;
}

/// Each run has as many digits proved as its precision has; what it is off by is its rounding.
TEST(ProvedRun, HasTheDigitsOfItsPrecision) {
  for (const auto& [precision, digits] : {std::pair("double", 15), {"mpfr:40", 40}}) {
    const hbvm::Run result = run(to_prove("hbvm:3,2", precision), {});
    ASSERT_TRUE(result.proved.has_value());
    EXPECT_EQ(result.proved->digits, digits);
    EXPECT_EQ(result.proved->steps, 10);
    EXPECT_EQ(result.proved->lambda_names, result.lambda_names);
    EXPECT_GT(std::stod(result.proved->off_q), 0);
    EXPECT_LT(std::stod(result.proved->off_q), 20 * std::pow(10, -digits));
    EXPECT_LT(std::stod(result.proved->off_p), 20 * std::pow(10, -digits));
  }
  EXPECT_FALSE(run(request_of(load_scene("double_pendulum"), "hbvm:3,2", "1/10", "1"), {}).proved.has_value());
}

TEST(ProvedRun, IsOfHbvmWithAnyNameOfIt) {
  EXPECT_TRUE(run(to_prove("gauss:2"), {}).proved.has_value());
  const hbvm::Run chosen = run(to_prove("hbvm:auto,2"), {});
  ASSERT_TRUE(chosen.proved.has_value());
  EXPECT_TRUE(chosen.proved->e_H_least.empty()) << chosen.proved->e_H_least;
}

TEST(ProvedRun, GoesBackInTime) {
  RunRequest request = to_prove("hbvm:3,2");
  request.direction = Direction::backward;
  const hbvm::Run result = run(request, {});
  EXPECT_LT(std::stod(result.proved->off_p), 1e-14);
}

TEST(ProvedRun, RefusesWhatHasNoProof) {
  for (const char* method : {"rk4", "rattle", "projected_hbvm:3,2", "radau:2"})
    expect_words(message_of([&] { run(to_prove(method), {}); }), {"the method is", method, "hbvm:K,S"});
  RunRequest divided = to_prove("hbvm:3,2");
  divided.on_failure = OnFailure::halve;
  expect_words(message_of([&] { run(divided, {}); }), {"proof", "divided"});
  RunRequest started = to_prove("hbvm:3,2");
  started.start = StartState{};
  expect_words(message_of([&] { run(started, {}); }), {"proof", "exact start of the scene"});
}

/// Where nodes were raised on the way there is no one method.
TEST(ProvedRun, RefusesRaisedNodes) {
  NodeLog nodes;
  nodes.raised.push_back({});
  nodes.raised.back().k = 9;
  const RunRequest request = to_prove("hbvm:8,2");
  const State<double> end(Vector<double>::Zero(4), Vector<double>::Zero(4));
  expect_words(message_of([&] { prove_run<double>(request, *request.method, nodes, end, {}); }), {"hbvm:9,2"});
}

}  // namespace
}  // namespace hbvm::core
