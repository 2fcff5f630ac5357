#include <algorithm>
#include <cmath>
#include <cstdio>

#include "cli/program.hpp"

namespace hbvm {
namespace {

namespace fs = std::filesystem;

/// |y(1) - y'(1)|_max of the implicit midpoint rule with 2^i and 2^(i+1) steps on the unit circle: a step turns by
/// 2 atan(h/2).
std::string figure(int i) {
  const auto angle = [](int n) { return 2 * n * std::atan(0.5 / n); };
  const double a = angle(1 << i), b = angle(2 << i);
  char text[32];
  std::snprintf(text, sizeof text, "%.2e",
                std::max(std::abs(std::cos(a) - std::cos(b)), std::abs(std::sin(a) - std::sin(b))));
  return text;
}

/// Two halvings for a body on a spring that turns about its end.
class StudyCommand : public ::testing::Test {
 protected:
  void SetUp() override {
    fs::create_directory(path);
    write("scene.toml",
          "dimension = 2\npoint = [{ name = \"O\", position = [0, 0] }]\n"
          "body = [{ name = \"a\", mass = 1, position = [1, 0], velocity = [0, 1] }]\n"
          "effect = [{ kind = \"trap\", center = \"O\", stiffness = 1, exponent = 2 }]\n");
    write("study.toml",
          "title = \"Small\"\nkind = \"step_halving\"\nscene = \"scene.toml\"\nstep = \"2^(-i)\"\nuntil = 1\n"
          "group = \"s\"\ncolumns = [\"e_y\", \"e_H\"]\ncompare_above = \"1e-12\"\nround_off = [\"e_H\"]\n"
          "block = [{ method = \"hbvm:1,1\", first = 1, last = 2 }]\n");
    expect(figure(2));
  }
  void write(const std::string& name, const std::string& text) const { folder.write("small/" + name, text); }
  std::string text(const std::string& name) const { return text_of(folder / ("small/" + name)); }
  /// The second row's expected figure.
  void expect(const std::string& e_y) const {
    write("expected.csv", "# k,s,i,e_y\n1,1,1," + figure(1) + "\n1,1,2," + e_y + "\n");
  }
  void replace(const std::string& from, const std::string& to) const {
    std::string study = text("study.toml");
    ASSERT_NE(study.find(from), std::string::npos);
    write("study.toml", study.replace(study.find(from), from.size(), to));
  }

  const Folder folder;
  const std::string path = folder / "small";
};

TEST_F(StudyCommand, ChecksTheExpectedFigures) {
  for (const char* precision : {"double", "quad", "mpfr:40"}) {
    const Outcome outcome = hbvm({"study", path, "--check", "--precision", precision});
    EXPECT_EQ(outcome.code, 0) << outcome.out;
    EXPECT_EQ(outcome.err, "");
    EXPECT_NE(outcome.out.find("Small, " + std::string(precision) + ": 2 of 2 printed figures agree"),
              std::string::npos)
        << outcome.out;
    EXPECT_TRUE(outcome.out.ends_with("2 of 2 printed figures agree\n")) << outcome.out;
    for (const int i : {1, 2}) EXPECT_NE(outcome.out.find(figure(i)), std::string::npos) << outcome.out;
  }
}

TEST_F(StudyCommand, ExitsWithOneIfAFigureDoesNotAgree) {
  expect("1.00e-01");
  const Outcome outcome = hbvm({"study", path, "--check"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_EQ(outcome.err, "");
  EXPECT_NE(outcome.out.find("not met: k = 1, s = 1, i = 2: e_y is " + figure(2) + ", printed 1.00e-01"),
            std::string::npos)
      << outcome.out;
  EXPECT_TRUE(outcome.out.ends_with("1 of 2 printed figures agree\n")) << outcome.out;
}

/// Whatever the studies after it say.
TEST_F(StudyCommand, ExitsWithOneIfAnyStudyDoesNotAgree) {
  const std::string good = folder / "good", bad = path;
  fs::copy(path, good);
  expect("1.00e-01");
  EXPECT_EQ(hbvm({"study", bad, good, "--check"}).code, 1);
  EXPECT_EQ(hbvm({"study", good, bad, "--check"}).code, 1);
  EXPECT_EQ(hbvm({"study", good, good, "--check"}).code, 0);
  EXPECT_EQ(hbvm({"study", bad, good}).code, 0) << "without --check";
}

TEST_F(StudyCommand, WithoutCheckComparesNothing) {
  fs::remove(path + "/expected.csv");
  const Outcome outcome = hbvm({"study", path});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("Small, double: done"), std::string::npos) << outcome.out;
  EXPECT_EQ(outcome.out.find("agree"), std::string::npos) << outcome.out;
}

TEST_F(StudyCommand, RunsEveryFolderInEveryPrecision) {
  const std::string other = folder / "other";
  fs::copy(path, other);
  const Outcome outcome = hbvm({"study", path, other, "--precision", "double", "mpfr:30", "--check"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(outcome.out.ends_with("8 of 8 printed figures agree\n")) << outcome.out;
  for (const std::string& where : {path, other})
    for (const char* precision : {"double", "mpfr_30"})
      for (const char* file : {"table.csv", "table.md", "table.tex"})
        EXPECT_NE(text_of(where + "/results/" + precision + "/" + file).find(figure(1)), std::string::npos)
            << where << " " << precision << " " << file;
}

TEST_F(StudyCommand, RefusesBadInput) {
  expect_refused({"study"}, {"folders"});
  expect_refused({"study", folder / "none"}, {"none"});
  expect_refused({"study", path, folder / "none"}, {"none"});
  expect_refused({"study", path, "--precision", "half"}, {"half"});
  expect_refused({"study", path, "--bogus"}, {"--bogus"});
  fs::remove(path + "/expected.csv");
  expect_refused({"study", path, "--check"}, {"expected.csv"});
  write("expected.csv", "# k,s,i,e_y\n1,1,1\n");
  expect_refused({"study", path, "--check"}, {"expected.csv", "3 cells"});
}

TEST_F(StudyCommand, RefusesABadStudy) {
  const std::string good = text("study.toml");
  const auto refused = [&](const std::string& from, const std::string& to, const std::vector<std::string>& words) {
    write("study.toml", good);
    replace(from, to);
    expect_refused({"study", path}, words);
  };
  refused("step_halving", "step_doubling", {"study.toml", "unknown kind 'step_doubling'"});
  refused("compare_above", "compare_abov", {"study.toml:8", "'compare_abov'"});
  refused("group = \"s\"", "group = \"i\"", {"study.toml", "'group'"});
  refused("\"e_y\"", "\"e_z\"", {"'e_z'"});
  refused("round_off = [\"e_H\"]", "round_off = [\"e_h\"]", {"study.toml:9", "'e_h'"});
  refused("hbvm:1,1", "hbvm:auto,1", {"study.toml:10", "states its k"});
  refused("hbvm:1,1", "hbvm:1,2", {"hbvm:1,2"});
  refused("last = 2", "last = 0", {"study.toml:10", "'first' and 'last'"});
  refused("last = 2", "last = 2, first = 1", {"study.toml:10"});
  refused("scene.toml", "scene_2.toml", {"scene_2.toml"});
  refused("\"2^(-i)\"", "\"2^(-j)\"", {"j"});
  refused("until = 1", "until = \"1/3\"", {"divide"});
  refused("title", "titel", {"study.toml:1", "'titel'", "'title'"});
}

TEST_F(StudyCommand, RefusesResultsThatCannotBeWritten) {
  write("results", "a file, and no folder");
  expect_refused({"study", path}, {"cannot write", "results"});
}

TEST_F(StudyCommand, ExitsWithThreeIfTheIntegrationFails) {
  write("scene.toml", fall());
  replace("until = 1", "until = 2");
  const Outcome outcome = hbvm({"study", path});
  EXPECT_EQ(outcome.code, 3) << outcome.out;
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(lines_of(outcome.err).size(), 1u) << outcome.err;
}

}  // namespace
}  // namespace hbvm
