#include <nlohmann/json.hpp>

#include "cli/program.hpp"
#include "folder.hpp"

namespace hbvm::core {
namespace {

TEST(SectionCommand, WritesPointsAndAPage) {
  const Folder folder;
  const Arguments arguments{"section", "double_pendulum", "--plane",    "a.x",      "--axes",   "b.x",
                            "b.vx",    "--starts",        "b.mass=1,2", "--method", "hbvm:2,2", "--step",
                            "1/8",     "--until",         "30"};
  expect_words(ended_with(0, arguments + Arguments{"--csv", folder / "s.csv", "--plot", folder / "s.html"}).out,
               {"orbit 1, b.mass = 1", "points"});
  EXPECT_EQ(text_of(folder.path() / "s.csv").substr(0, 23), "orbit,b.mass,t,b.x,b.vx");
  EXPECT_NE(text_of(folder.path() / "s.html").find("<canvas id=\"points\""), std::string::npos);
  const auto json = nlohmann::json::parse(ended_with(0, arguments + Arguments{"--json"}).out);
  EXPECT_EQ(json.at("orbits").size(), 2u);
  // In shards, and put together.
  for (const char* const shard : {"1/2", "2/2"})
    expect_words(
        ended_with(0, arguments + Arguments{"--out", folder / (shard[0] + std::string("of2")), "--shard", shard}).out,
        {"--merge"});
  const auto merged = nlohmann::json::parse(
      ended_with(0, arguments + Arguments{"--out", folder / "all", "--merge", folder / "1of2/orbits.jsonl",
                                          folder / "2of2/orbits.jsonl", "--json"})
          .out);
  EXPECT_EQ(merged, json);
  expect_refused(arguments + Arguments{"--starts", "b.mass=1"}, {"twice"});
}

}  // namespace
}  // namespace hbvm::core
