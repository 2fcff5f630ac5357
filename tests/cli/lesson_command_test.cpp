#include "cli/json.hpp"
#include "cli/program.hpp"
#include "folder.hpp"
#include "hbvm/lesson.hpp"
#include "read_file.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

TEST(LessonCommand, ListsAndShows) {
  const Outcome list = hbvm({"lesson", "list"}), show = hbvm({"lesson", "show", "1"});
  EXPECT_EQ(list.code, 0);
  expect_words(list.out, {" 1  A pendulum in x and y", "10  "});
  expect_words(show.out, {"Lesson 1", "Exercise 'hidden'", "rk4+baumgarte"});
  EXPECT_EQ(json_of({"lesson", "list", "--json"}).size(), 10u);
}

TEST(LessonCommand, ChecksAnswers) {
  const Folder folder;
  const std::string right = folder.write("right.toml", "[baumgarte]\nA = 1\n[hidden]\nfactor = 4\n"),
                    wrong = folder.write("wrong.toml", "[baumgarte]\nA = 1\n[hidden]\nfactor = 16\n");
  const Outcome good = hbvm({"lesson", "check", "1", right}), bad = hbvm({"lesson", "check", "01", wrong});
  EXPECT_EQ(good.code, 0) << good.err;
  EXPECT_EQ(good.out, "baumgarte: right\nhidden: right\n");
  EXPECT_EQ(bad.code, 1) << bad.err;
  expect_words(bad.out, {"baumgarte: right\nhidden: not right. Divide"});
  const Outcome json = hbvm({"lesson", "check", "1", wrong, "--json"});
  EXPECT_EQ(json.code, 1);
  EXPECT_EQ(nlohmann::json::parse(json.out).at("exercises").at(1).at("right"), false);
}

TEST(LessonCommand, BeginsAFolder) {
  const Folder folder;
  const std::string out = folder / "four";
  EXPECT_EQ(hbvm({"lesson", "begin", "4", "--out", out}).code, 0);
  expect_words(read_file(out + "/answers.toml"), {"# Lesson 4", "hbvm lesson check 4 answers.toml"});
  for (const auto& [name, text] : lesson("4").files) EXPECT_EQ(read_file(out + "/" + name), text);
  EXPECT_FALSE(lesson("4").files.empty());
  // Nothing that somebody wrote is written over.
  expect_refused({"lesson", "begin", "4", "--out", out}, {"is there already", "--out"});
  EXPECT_EQ(hbvm({"lesson", "check", "4", out + "/answers.toml"}).code, 1);
}

TEST(LessonCommand, RefusesWhatThereIsNot) {
  const Folder folder;
  expect_refused({"lesson", "check", "12", folder.write("a.toml", "")}, {"no lesson '12'"});
  expect_refused({"lesson", "check", "1", folder.write("b.toml", "[hiden]\n")}, {"b.toml", "did you mean 'hidden'"});
  expect_refused({"lesson", "check", "1", folder.write("c.toml", "[hidden\n")}, {"c.toml"});
  expect_refused({"lesson", "check", "1", "/nowhere.toml"}, {"/nowhere.toml"});
  expect_refused({"lesson"}, {"subcommand is required"});
}

}  // namespace
}  // namespace hbvm::core
