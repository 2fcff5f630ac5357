#include <csignal>
#include <map>
#include <nlohmann/json.hpp>

#include "cli/program.hpp"

namespace hbvm::core {
namespace {

using Json = nlohmann::json;

const Arguments small{"cost",   "double_pendulum", "--digits-range", "2:10", "--methods",
                      "rattle", "hbvm:3,3",        "--seconds",      "0.01"};

/// What of the cells is no time.
std::map<std::string, Json> timeless(const std::string& json) {
  std::map<std::string, Json> result;
  const Json parsed = Json::parse(json);
  for (Json cell : parsed.at("cells")) {
    for (const char* const time :
         {"seconds", "spread", "slowdown", "setup_seconds", "repetitions", "disturbed", "front"})
      cell.erase(time);
    result[cell.at("method").get<std::string>() + cell.at("step").get<std::string>()] = cell;
  }
  return result;
}

TEST(CostCommand, WritesTablesAndFiguresAndGoesOn) {
  const Folder folder;
  const Arguments arguments = small + Arguments{"--out", folder / "out"};
  const Outcome first = hbvm(arguments);
  ASSERT_EQ(first.code, 0) << first.err;
  expect_words(first.out, {"the least time for so many right digits"});
  for (const char* const file : {"cost.csv", "cost.csv-metadata.json", "cost.json", "cells.jsonl"})
    EXPECT_FALSE(text_of(folder / ("out/" + std::string(file))).empty()) << file;
  const std::string store = folder / "out/cells.jsonl", all = text_of(store);
  const std::string json = text_of(folder / "out/cost.json");
  // As if it had been ended in the middle of a line.
  std::ofstream(store, std::ios::binary) << all.substr(0, all.size() / 2);
  EXPECT_EQ(hbvm(arguments).code, 0);
  EXPECT_EQ(timeless(text_of(folder / "out/cost.json")), timeless(json));
}

TEST(CostCommand, MergesShards) {
  const Folder folder;
  Arguments merged = small + Arguments{"--out", folder / "merged", "--json", "--merge"};
  for (int i = 1; i <= 5; ++i) {
    const std::string out = folder / std::to_string(i);
    const Outcome part = hbvm(small + Arguments{"--out", out, "--shard", std::to_string(i) + "/5"});
    ASSERT_EQ(part.code, 0) << part.err;
    merged.push_back(out + "/cells.jsonl");
  }
  const Outcome all = hbvm(merged), alone = hbvm(small + Arguments{"--json"});
  ASSERT_EQ(all.code, 0) << all.err;
  EXPECT_EQ(timeless(all.out), timeless(alone.out));
  merged.pop_back();
  EXPECT_EQ(hbvm(merged).code, 0) << "what is in --out is known";
}

TEST(CostCommand, PicksTheCheapestSetting) {
  const Outcome outcome = hbvm({"cost", "double_pendulum", "--digits", "8", "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Json json = Json::parse(outcome.out);
  EXPECT_EQ(json.at("digits"), 8);
  EXPECT_LE(json.at("measured").at("error"), 1e-8);
  EXPECT_GT(json.at("measured").at("seconds"), 0);
  EXPECT_GT(json.at("predicted").at("seconds"), 0);
  EXPECT_FALSE(json.at("runners_up").empty());
  // The command it ends with makes that run.
  const Json& pick = json.at("pick");
  EXPECT_EQ(json.at("run"), "hbvm run double_pendulum --method " + pick.at("method").get<std::string>() + " --step " +
                                pick.at("step").get<std::string>() + " --until 10 --precision " +
                                pick.at("precision").get<std::string>());
  EXPECT_EQ(hbvm({"run", "double_pendulum", "--method", pick.at("method"), "--step", pick.at("step"), "--until", "10",
                  "--precision", pick.at("precision")})
                .code,
            0);
}

TEST(CostCommand, RefusesWhatItCannotMean) {
  const Arguments scene{"cost", "kepler"};
  expect_refused(scene + Arguments{"--digits-range", "10"}, {"--digits-range", "A:B"});
  expect_refused(scene + Arguments{"--digits-range", "10:5"}, {"10:5"});
  expect_refused(scene + Arguments{"--digits-range", "x:5"}, {"'x'"});
  expect_refused(scene + Arguments{"--quantity", "H"}, {"q, p, lambda or all"});
  expect_refused(scene + Arguments{"--quantity", "lambda", "--digits", "5"}, {"no constraints"});
  expect_refused(scene + Arguments{"--methods", "gaus"}, {"'gauss'"});
  expect_refused(scene + Arguments{"--precisions", "single"}, {"single"});
  expect_refused(scene + Arguments{"--seconds", "0"}, {"--seconds"});
  expect_refused(scene + Arguments{"--digits", "0"}, {"--digits 0"});
  expect_refused(scene + Arguments{"--until", "2*"}, {"--until"});
  expect_refused(scene + Arguments{"--digits", "5", "--jobs", "2"}, {"--jobs"});
  expect_refused({"cost", "keppler"}, {"keppler"});
}

}  // namespace
}  // namespace hbvm::core
