#include <csignal>
#include <map>

#include "cli/json.hpp"

namespace hbvm::core {
namespace {

using nlohmann::ordered_json;

const Arguments small{"cost",   "double_pendulum", "--digits-range", "2:10", "--methods",
                      "rattle", "hbvm:3,3",        "--seconds",      "0.01"};

/// What of the cells is no time.
std::map<std::string, ordered_json> timeless(const ordered_json& json) {
  std::map<std::string, ordered_json> result;
  for (ordered_json cell : json.at("cells")) {
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
  expect_words(ended_with(0, arguments).out, {"the least time for so many right digits"});
  for (const char* const file : {"cost.csv", "cost.csv-metadata.json", "cost.json", "cells.jsonl"})
    EXPECT_FALSE(text_of(folder / ("out/" + std::string(file))).empty()) << file;
  const std::string store = folder / "out/cells.jsonl", all = text_of(store), json = text_of(folder / "out/cost.json");
  // As if it had been ended in the middle of a line.
  folder.write(store, all.substr(0, all.size() / 2));
  ended_with(0, arguments);
  EXPECT_EQ(timeless(ordered_json::parse(text_of(folder / "out/cost.json"))), timeless(ordered_json::parse(json)));
}

TEST(CostCommand, MergesShards) {
  const Folder folder;
  Arguments merged = small + Arguments{"--json", "--out", folder / "merged", "--merge"};
  for (int i = 1; i <= 5; ++i) {
    const std::string out = folder / std::to_string(i);
    ended_with(0, small + Arguments{"--out", out, "--shard", std::to_string(i) + "/5"});
    merged.push_back(out + "/cells.jsonl");
  }
  EXPECT_EQ(timeless(ordered_json::parse(ended_with(0, merged).out)), timeless(json_of(small)));
  merged.pop_back();
  ended_with(0, merged);  // what is in --out is known
}

TEST(CostCommand, PicksTheCheapestSetting) {
  const ordered_json json = json_of({"cost", "double_pendulum", "--digits", "8"});
  EXPECT_EQ(json.at("digits"), 8);
  EXPECT_LE(json.at("measured").at("error"), 1e-8);
  EXPECT_GT(json.at("measured").at("seconds"), 0);
  EXPECT_GT(json.at("predicted").at("seconds"), 0);
  EXPECT_FALSE(json.at("runners_up").empty());
  // The command it ends with makes that run.
  const ordered_json& pick = json.at("pick");
  const std::string method = pick.at("method"), step = pick.at("step"), precision = pick.at("precision");
  EXPECT_EQ(json.at("run"),
            "hbvm run double_pendulum --method " + method + " --step " + step + " --until 10 --precision " + precision);
  ended_with(0, run_of("double_pendulum", method, step, "10") + Arguments{"--precision", precision});
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
