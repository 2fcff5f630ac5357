#include "folder_report/json_facts.hpp"

#include <gtest/gtest.h>

#include "words.hpp"

namespace hbvm::core {
namespace {

TEST(JsonFacts, AreTheNumbersAndTextsByName) {
  const std::vector<Fact> facts = read_facts(
      R"({"digits": 5, "pick": {"method": "rattle"}, "q": ["1", "2"], "many": [1,2,3,4,5,6,7,8,9,10,11,12,13],
          "others": [{"step": "1/4"}]})",
      "f.json");
  const std::vector<std::pair<std::string, std::string>> expected{{"digits", "5"},
                                                                  {"pick.method", "rattle"},
                                                                  {"q", "[\"1\",\"2\"]"},
                                                                  {"many", "13 entries"},
                                                                  {"others[0].step", "1/4"}};
  ASSERT_EQ(facts.size(), expected.size());
  for (std::size_t i = 0; i < facts.size(); ++i) {
    EXPECT_EQ(facts[i].name, expected[i].first);
    EXPECT_EQ(facts[i].values, std::vector<std::string>{expected[i].second});
  }
}

TEST(JsonFacts, AreSaidOnce) {
  std::vector<Fact> facts;
  for (const char* const value : {"a", "b", "a"}) add_fact(facts, {"command", {value}});
  ASSERT_EQ(facts.size(), 1u);
  EXPECT_EQ(facts[0].values, (std::vector<std::string>{"a", "b"}));
  EXPECT_TRUE(is_provenance("command"));
  EXPECT_FALSE(is_provenance("seconds"));
}

TEST(JsonFacts, DescribeACsv) {
  const Description description = read_description(
      R"({"dc:title": "T", "dc:source": "S", "hbvm:version": "1", "url": "f.csv",
          "tableSchema": {"columns": [{"titles": "t", "dc:description": "time"}, {"titles": "x"}]}})",
      "f.json");
  EXPECT_EQ(description.title, "T");
  EXPECT_EQ(description.source, "S");
  ASSERT_EQ(description.facts.size(), 1u);
  EXPECT_EQ(description.facts[0].name, "version");
  EXPECT_EQ(description.columns.at("t"), "time");
  EXPECT_FALSE(description.columns.contains("x"));
}

TEST(JsonFacts, SayWhichLineIsWrong) {
  const std::string refusal = message_of([] { read_facts("{\n\"a\": 1,\n}\n", "f.json"); });
  EXPECT_TRUE(refusal.starts_with("f.json:3: no JSON")) << refusal;
}

}  // namespace
}  // namespace hbvm::core
