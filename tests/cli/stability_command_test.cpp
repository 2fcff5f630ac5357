#include <nlohmann/json.hpp>

#include "cli/program.hpp"

namespace hbvm {
namespace {

using Json = nlohmann::json;

/// Quick ones that hold whatever the solvers do.
const Arguments sure{"stability", "--cases", "Gauss-Legendre"};

TEST(StabilityCommand, PrintsOneJsonObject) {
  const Outcome outcome = hbvm(sure + Arguments{"--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err << outcome.out;
  const Json json = Json::parse(outcome.out);
  const Json& cases = json.at("cases");
  ASSERT_EQ(cases.size(), 9u);
  for (const Json& c : cases) {
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
  const Outcome first = hbvm(arguments);
  EXPECT_EQ(first.code, 0) << first.err << first.out;
  for (const char* const file : {"stability.csv", "stability.md", "stability.json", "results.jsonl"})
    EXPECT_FALSE(text_of(folder / ("out/" + std::string(file))).empty()) << file;
  // As if it had been ended in the middle of a line.
  const std::string store = folder / "out/results.jsonl", all = text_of(store);
  std::ofstream(store, std::ios::binary) << all.substr(0, all.size() / 2);
  EXPECT_EQ(hbvm(arguments).out, first.out);
  // What it found counts: a case that is wrong ends the program with 1.
  std::string wrong = text_of(store);
  const std::string holds = "\"verdict\":\"holds\"";
  ASSERT_NE(wrong.find(holds), std::string::npos);
  wrong.replace(wrong.find(holds), holds.size(), "\"verdict\":\"not as expected\"");
  std::ofstream(store, std::ios::binary) << wrong;
  const Outcome third = hbvm(arguments);
  EXPECT_EQ(third.code, 1) << third.err;
  EXPECT_NE(third.out.find("8 hold, 0 fail as expected, 0 warn as expected, 1 is not as expected"), std::string::npos)
      << third.out;
}

TEST(StabilityCommand, RefusesBadInput) {
  expect_refused({"stability", "--quick", "--full"}, {"--full"});
  expect_refused({"stability", "--jobs", "0"}, {"--jobs"});
  expect_refused({"stability", "--cases", "no such case"}, {"no such case", "separatrix"});
  expect_refused({"stability", "--out", "/proc/nowhere"}, {"/proc/nowhere"});
}

}  // namespace
}  // namespace hbvm
