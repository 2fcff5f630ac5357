#include <gtest/gtest.h>

#include "cli/program.hpp"

namespace hbvm::core {
namespace {

TEST(Scenes, ListsThePapersFourWithTheirTitles) {
  const Outcome outcome = hbvm({"scenes"});
  EXPECT_EQ(outcome.code, 0);
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
  for (const std::string& line : lines_of(hbvm({"scenes"}).out)) {
    const std::string name = line.substr(0, line.find(' '));
    const Outcome run = hbvm({"run", name, "--method", "hbvm:2,2", "--step", "0.01", "--until", "0.01"});
    EXPECT_EQ(run.code, 0) << name << ": " << run.err;
  }
}

}  // namespace
}  // namespace hbvm::core
