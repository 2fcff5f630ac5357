#include <gtest/gtest.h>

#include "cli/program.hpp"

namespace hbvm::core {
namespace {

/// The subcommands that `hbvm --help` lists.
std::vector<std::string> subcommands() {
  std::vector<std::string> result;
  bool listed = false;
  for (const std::string& line : lines_of(hbvm({"--help"}).out)) {
    if (listed && line.empty()) break;
    if (listed) result.push_back(line.substr(2, line.find(' ', 2) - 2));
    listed = listed || line == "Subcommands:";
  }
  return result;
}

TEST(Help, ListsTheSubcommands) {
  const std::vector<std::string> names = subcommands();
  for (const char* name : {"run", "nodes", "scenes", "scene", "study"})
    EXPECT_EQ(std::count(names.begin(), names.end(), name), 1) << name;
}

void expect_help(const Arguments& arguments) {
  const Outcome help = ended_with(0, arguments);
  EXPECT_EQ(help.err, "");
  expect_words(help.out, {"Example", "hbvm " + (arguments.size() > 1 ? arguments[0] : std::string())});
}

TEST(Help, OfEverySubcommandShowsAnExample) {
  expect_help({"--help"});
  for (const std::string& name : subcommands()) {
    SCOPED_TRACE(name);
    expect_help({name, "--help"});
    expect_help({name, "-h"});
  }
}

TEST(Help, OfTheSubcommandsOfSceneShowsAnExample) {
  for (const char* name : {"check", "project"}) {
    const std::string help = ended_with(0, {"scene", name, "--help"}).out;
    expect_words(help, {"Example: hbvm scene " + std::string(name), "--precision"});
    EXPECT_EQ(help.find("--out") != std::string::npos, name == std::string("project")) << help;
  }
}

TEST(Help, OfRunNamesEveryOption) {
  const std::string help = hbvm({"run", "--help"}).out;
  expect_words(help, {"scene", "--method", "--step", "--until", "--precision", "--solver", "--out", "--every",
                      "--account", "--json"});
}

TEST(Version, IsOneLine) {
  const std::string version = ended_with(0, {"--version"}).out;
  ASSERT_EQ(lines_of(version).size(), 1u);
  EXPECT_TRUE(version.starts_with("0.")) << version;
}

}  // namespace
}  // namespace hbvm::core
