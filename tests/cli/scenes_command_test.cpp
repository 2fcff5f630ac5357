#include <gtest/gtest.h>

#include "cli/json.hpp"
#include "cli/program.hpp"

namespace hbvm::core {
namespace {

using Json = nlohmann::json;

TEST(Scenes, ListsThePapersFourWithTheirTitles) {
  const Outcome outcome = ended_with(0, {"scenes"});
  EXPECT_EQ(outcome.err, "");
  for (const std::string name : {"simple_pendulum", "modified_pendulum", "conical_pendulum", "tethered_satellites"}) {
    int found = 0;
    for (const std::string& line : lines_of(outcome.out)) {
      if (!line.starts_with(name + " ")) continue;
      ++found;
      EXPECT_GT(line.size(), line.find_first_not_of(' ', name.size())) << "no title: " << line;
    }
    EXPECT_EQ(found, 1) << name;
  }
}

TEST(Scenes, ListsOnlyScenesThatRun) {
  for (const std::string& line : lines_of(hbvm({"scenes"}).out))
    ended_with(0, run_of(line.substr(0, line.find(' ')), "hbvm:2,2", "0.01", "0.01"));
}

TEST(Scenes, AreAlsoJson) {
  const Json scenes = Json::parse(ended_with(0, {"scenes", "--json"}).out).at("scenes");
  EXPECT_EQ(scenes.size(), lines_of(hbvm({"scenes"}).out).size());
  for (const Json& scene : scenes) ended_with(0, {"scene", "check", scene.at("name").get<std::string>()});
}

}  // namespace
}  // namespace hbvm::core
