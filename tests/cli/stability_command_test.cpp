#include "checksum.hpp"
#include "cli/json.hpp"

namespace hbvm::core {
namespace {

using nlohmann::ordered_json;

/// Quick ones that hold whatever the solvers do.
const Arguments sure{"stability", "--cases", "Gauss-Legendre"};

TEST(StabilityCommand, PrintsOneJsonObject) {
  const ordered_json cases = json_of(sure).at("cases");
  ASSERT_EQ(cases.size(), 9u);
  for (const ordered_json& c : cases) {
    for (const char* const key : {"case", "parameter", "precision", "expected", "verdict"})
      EXPECT_TRUE(c.at(key).is_string()) << key;
    for (const char* const key : {"figure", "bound"}) EXPECT_TRUE(c.at(key).is_number()) << key;
    EXPECT_EQ(c.at("verdict"), "holds") << c.dump();
    EXPECT_LE(c.at("figure"), c.at("bound"));
  }
}

TEST(StabilityCommand, GoesOnFromWhatItFound) {
  const Folder folder;
  const Arguments arguments = sure + Arguments{"--out", folder / "out"};
  const Outcome first = ended_with(0, arguments);
  for (const char* const file : {"stability.csv", "stability.md", "stability.json", "results.jsonl"})
    EXPECT_FALSE(text_of(folder / ("out/" + std::string(file))).empty()) << file;
  // As if it had been ended in the middle of a line.
  const std::string store = folder / "out/results.jsonl", all = text_of(store);
  folder.write(store, all.substr(0, all.size() / 2));
  EXPECT_EQ(hbvm(arguments).out, first.out);
  EXPECT_EQ(text_of(store), all);
  // A line that was changed is not believed.
  std::string wrong = all;
  const std::string holds = "\"verdict\":\"holds\"";
  ASSERT_NE(wrong.find(holds), std::string::npos);
  wrong.replace(wrong.find(holds), holds.size(), "\"verdict\":\"not as expected\"");
  folder.write(store, wrong);
  ended_with(0, arguments);
  EXPECT_EQ(text_of(store), all);
  // What it found counts: a case that is wrong ends the program with 1.
  const std::string line = wrong.substr(0, wrong.find(",\"checksum\":"));
  folder.write(store, line + ",\"checksum\":\"" + Checksum(line).text() + "\"}\n");
  expect_words(ended_with(1, arguments).out, {"8 hold, 0 fail as expected, 0 warn as expected, 1 is not as expected"});
}

TEST(StabilityCommand, MergesShardsToTheSameFiles) {
  const Folder folder;
  Arguments merged = sure + Arguments{"--out", folder / "merged", "--merge"};
  for (const char* const shard : {"1/2", "2/2"}) {
    const std::string out = folder / (std::string("shard") + shard[0]);
    const Outcome outcome = ended_with(0, sure + Arguments{"--shard", shard, "--out", out});
    expect_words(outcome.out, {shard[0] == '1' ? "5 cases: 5 hold" : "4 cases: 4 hold"});
    expect_refused(sure + Arguments{"--out", folder / "part", "--merge", out + "/results.jsonl"},
                   {"in none of these files"});
    merged.push_back(out + "/results.jsonl");
  }
  ended_with(0, merged);
  ended_with(0, sure + Arguments{"--jobs", "1", "--out", folder / "one"});
  for (const char* const name : {"results.jsonl", "stability.csv", "stability.md"})
    EXPECT_EQ(text_of(folder / ("merged/" + std::string(name))), text_of(folder / ("one/" + std::string(name))))
        << name;
}

TEST(StabilityCommand, RefusesBadInput) {
  expect_refused({"stability", "--quick", "--full"}, {"--full"});
  expect_refused({"stability", "--jobs", "0"}, {"--jobs"});
  expect_refused({"stability", "--shard", "3/2", "--out", "/proc/nowhere"}, {"--shard", "3/2"});
  expect_refused({"stability", "--shard", "1/2"}, {"--out", "results.jsonl"});
  expect_refused({"stability", "--merge", "absent", "--shard", "1/2"}, {"--merge"});
  expect_refused({"stability", "--cases", "no such case"}, {"no such case", "separatrix"});
  expect_refused({"stability", "--out", "/proc/nowhere"}, {"/proc/nowhere"});
}

}  // namespace
}  // namespace hbvm::core
