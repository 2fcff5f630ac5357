#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "hbvm/error.hpp"
#include "hbvm/results.hpp"
#include "hbvm/run.hpp"
#include "hbvm/table.hpp"
#include "words.hpp"

namespace hbvm {
namespace {

/// A run to t = 2 as a file of results.
ResultsFile file_of(const std::string& step, const std::string& method = "verlet") {
  const hbvm::Run made = run({.scene = load_scene("kepler"), .method = method, .step = step, .until = 2});
  return {step,
          to_csv({.caption = {},
                  .provenance = {},
                  .key_columns = {},
                  .columns = made.trajectory.columns,
                  .groups = {{.heading = {}, .keys = {}, .rows = made.trajectory.rows}}}),
          step};
}

ResultsRequest two_steps() { return {.scene = load_scene("kepler"), .files = {file_of("1/64"), file_of("1/128")}}; }

TEST(DoorResults, TellsRightDigitsAndTheOrder) {
  const Comparison against = compare_results(two_steps());
  ASSERT_EQ(against.files.size(), 2u);
  EXPECT_NEAR(against.order(), 2, 0.1);
  EXPECT_GT(against.least_digits(), 1);
  EXPECT_LT(against.least_digits(), 5);
  const auto json = nlohmann::json::parse(to_json(against));
  EXPECT_EQ(json["orders"][0].get<double>(), against.order());
  EXPECT_EQ(json["files"][1]["right_digits"].size(), 4u);
}

TEST(DoorResults, TakesTheStepThatAFileStores) {
  ResultsRequest request = two_steps();
  for (ResultsFile& file : request.files) {
    file.csv = "# step = " + file.step + "\n" + file.csv;
    file.step.clear();
  }
  EXPECT_NEAR(compare_results(request).order(), 2, 0.1);
}

TEST(DoorResults, RefusesWhatItCannotRead) {
  EXPECT_THROW(compare_results({.scene = load_scene("kepler"), .files = {}}), InputError);
  ResultsRequest request = two_steps();
  request.files.back().csv = "t,planet.x\n1,nan\n";
  core::expect_words(core::message_of([&] { compare_results(request); }), {"1/128:2", "planet.x"});
}

TEST(DoorResults, EndsWhenAsked) {
  ResultsRequest request = two_steps();
  std::stop_source source;
  source.request_stop();
  request.stop = source.get_token();
  EXPECT_THROW(compare_results(request), Interrupted);
}

}  // namespace
}  // namespace hbvm
