#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "cli/program.hpp"
#include "csv_line.hpp"
#include "scalar/text.hpp"

namespace hbvm::core {
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

/// The line that names files of one folder.
std::string written_together(const Arguments& files) {
  std::string line;
  for (const std::string& file : files) {
    const std::filesystem::path path(file);
    line += (line.empty() ? "written to " + path.parent_path().string() + ": " : ", ") + path.filename().string();
  }
  return line + "\n";
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
  /// What a study writes without figures.
  Arguments tables(std::string precision) const {
    if (precision.starts_with("mpfr:")) precision[4] = '_';
    Arguments files;
    for (const char* const name :
         {"table.csv", "table.md", "table.tex", "table_full.csv", "table_full.csv-metadata.json"})
      files.push_back(path + "/results/" + precision + "/" + name);
    return files;
  }
  /// The second row's expected figure.
  void expect(const std::string& e_y) const {
    write("expected.csv", "k,s,i,e_y\n1,1,1," + figure(1) + "\n1,1,2," + e_y + "\n");
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
    const Outcome outcome = ended_with(0, {"study", path, "--check", "--precision", precision});
    EXPECT_EQ(outcome.err, written_together(tables(precision)));
    expect_words(outcome.out,
                 {"Small, " + std::string(precision) + ": 2 of 2 printed figures agree", figure(1), figure(2)});
    EXPECT_TRUE(outcome.out.ends_with("2 of 2 printed figures agree\n")) << outcome.out;
    EXPECT_EQ(outcome.out.find("<!--"), std::string::npos) << "a comment is for the file";
  }
}

TEST_F(StudyCommand, ExitsWithOneIfAFigureDoesNotAgree) {
  expect("1.00e-01");
  const Outcome outcome = ended_with(1, {"study", path, "--check"});
  EXPECT_EQ(outcome.err, written_together(tables("double")));
  expect_words(outcome.out, {"not met: k = 1, s = 1, i = 2: e_y is " + figure(2) + ", printed 1.00e-01"});
  EXPECT_TRUE(outcome.out.ends_with("1 of 2 printed figures agree\n")) << outcome.out;
}

/// Whatever the studies after it say.
TEST_F(StudyCommand, ExitsWithOneIfAnyStudyDoesNotAgree) {
  const std::string good = folder / "good", bad = path;
  fs::copy(path, good);
  expect("1.00e-01");
  ended_with(1, {"study", bad, good, "--check"});
  ended_with(1, {"study", good, bad, "--check"});
  ended_with(0, {"study", good, good, "--check"});
  ended_with(0, {"study", bad, good});
}

TEST_F(StudyCommand, WithoutCheckComparesNothing) {
  fs::remove(path + "/expected.csv");
  const Outcome outcome = ended_with(0, {"study", path});
  expect_words(outcome.out, {"Small, double: done"});
  EXPECT_EQ(outcome.out.find("agree"), std::string::npos) << outcome.out;
}

TEST_F(StudyCommand, RunsEveryFolderInEveryPrecision) {
  const std::string other = folder / "other";
  fs::copy(path, other);
  const Outcome outcome = ended_with(0, {"study", path, other, "--precision", "double", "mpfr:30", "--check"});
  EXPECT_TRUE(outcome.out.ends_with("8 of 8 printed figures agree\n")) << outcome.out;
  for (const std::string& where : {path, other})
    for (const char* precision : {"double", "mpfr_30"})
      for (const char* file : {"table.csv", "table.md", "table.tex"})
        expect_words(text_of(where + "/results/" + precision + "/" + file), {figure(1)});
}

/// Every digit of what the table rounds; where it has a mark, nothing.
TEST_F(StudyCommand, WritesAllDigitsBesideTheTable) {
  for (const char* precision : {"double", "mpfr:40"}) {
    ended_with(0, {"study", path, "--precision", precision});
    const Arguments files = tables(precision);
    const auto printed = lines_of(text_of(files[0])), full = lines_of(text_of(files[3]));
    EXPECT_EQ(full.at(0), "k,s,i,e_y,e_H");
    ASSERT_EQ(full.size(), 3u);
    for (std::size_t row = 1; row < 3; ++row) {
      const auto digits = split_csv_line(full[row]), three = split_csv_line(printed.at(printed.size() - 3 + row));
      ASSERT_EQ(digits.size(), 5u);
      EXPECT_EQ(to_scientific(digits[3], 3), three.at(3));
      EXPECT_EQ(to_scientific(digits[4], 3), three.at(4));
      EXPECT_GT(digits[3].size(), precision[0] == 'd' ? 14u : 36u) << digits[3];
    }
    const auto metadata = nlohmann::json::parse(text_of(files[4]));
    EXPECT_EQ(metadata["url"], "table_full.csv");
    EXPECT_EQ(metadata["hbvm:precision"], precision);
    EXPECT_EQ(metadata["tableSchema"]["columns"].size(), 5u);
  }
}

/// With a picture, so that trajectories are among the runs.
class DividedStudy : public StudyCommand {
 protected:
  void SetUp() override {
    StudyCommand::SetUp();
    write("study.toml",
          text("study.toml") +
              "[[figure]]\nname = \"path\"\nrun = [{ method = \"hbvm:2,2\", step = \"1/8\", until = 1 }]\n"
              "panel = [{ title = \"Path\", x_label = \"x\", y_label = \"y\", curve = [{ x = \"a.x\", y = "
              "\"a.y\", label = \"q\" }] }]\n");
  }
  Arguments work(const std::string& out) const {
    return {"study", path, "--precision", "double", "mpfr:30", "--check", "--out", folder / out};
  }
  std::string runs_of(const std::string& out) const { return text_of(folder / (out + "/runs.jsonl")); }
  void expect_same(const std::string& out, const std::string& other) const {
    EXPECT_EQ(runs_of(out), runs_of(other));
    for (const char* const precision : {"double", "mpfr_30"})
      for (const char* const name :
           {"table.csv", "table.md", "table.tex", "table_full.csv", "path_1.csv", "path_1.csv-metadata.json"}) {
        const std::string file = std::string("/small/") + precision + "/" + name;
        EXPECT_FALSE(text_of(folder / (out + file)).empty()) << file;
        EXPECT_EQ(text_of(folder / (out + file)), text_of(folder / (other + file))) << file;
      }
  }
};

/// Tables are printed and written, the exit code says whether figures agree, and the picture is a warning.
TEST_F(DividedStudy, WithoutGnuplotHasItsTables) {
  const Outcome drawn = hbvm({"study", path, "--check"});
  EXPECT_EQ(drawn.err, written_together(tables("double") + with_metadata(path + "/results/double/path_1.csv") +
                                        Arguments{path + "/results/double/path.svg"}));
  const std::string before = std::getenv("PATH") ? std::getenv("PATH") : "";
  setenv("PATH", folder.write("no_programs", "").c_str(), 1);
  const Outcome outcome = ended_with(0, {"study", path, "--check"});
  setenv("PATH", before.c_str(), 1);
  EXPECT_TRUE(outcome.out.ends_with("pictures: none\n2 of 2 printed figures agree\n")) << outcome.out;
  expect_words(outcome.out, {figure(1)});
  EXPECT_TRUE(outcome.err.starts_with(
      written_together(tables("double") + with_metadata(path + "/results/double/path_1.csv")) + "warning: "))
      << outcome.err;
  expect_words(outcome.err, {"path.svg' is not drawn: pictures need gnuplot, which is not installed: apt install "
                             "gnuplot-nox\n"});
}

TEST_F(DividedStudy, GoesOnFromAFileCutAnywhere) {
  ended_with(0, work("one") + Arguments{"--jobs", "1"});
  EXPECT_FALSE(fs::exists(path + "/results")) << "they are in --out";
  const std::string all = runs_of("one");
  EXPECT_EQ(lines_of(all).size(), 8u) << "three steps and a trajectory, in two precisions";
  for (std::size_t n = 0; n < 5; ++n) {
    const std::size_t length = all.size() * n / 4;
    fs::create_directories(folder / "cut");
    folder.write("cut/runs.jsonl", all.substr(0, length));
    const Outcome outcome = ended_with(0, work("cut") + Arguments{"--jobs", "3"});
    EXPECT_TRUE(outcome.out.ends_with("4 of 4 printed figures agree\n")) << outcome.out;
    expect_same("cut", "one");
  }
}

/// Killed at any time, and started again until it ends.
TEST_F(DividedStudy, GoesOnAfterItWasKilled) {
  ended_with(0, work("one"));
  int code = -1;
  for (double time = 5'000; code != 0; time *= 1.4) {
    code = hbvm_killed_after(static_cast<long>(time), work("killed")).code;
    ASSERT_TRUE(code == 0 || code == -SIGPROF) << code;
  }
  expect_same("killed", "one");
}

TEST_F(DividedStudy, MergesShardsToTheSameFiles) {
  ended_with(0, work("one"));
  Arguments merged = work("merged") + Arguments{"--merge"};
  for (const char* const shard : {"1/3", "2/3", "3/3"}) {
    const std::string out = std::string("shard") + shard[0];
    const Outcome outcome = ended_with(0, work(out) + Arguments{"--shard", shard});
    expect_words(outcome.out, {"the runs of shard " + std::string(shard)});
    EXPECT_EQ(outcome.out.find("agree"), std::string::npos) << outcome.out;
    expect_refused(work("part") + Arguments{"--merge", folder / (out + "/runs.jsonl")}, {"in none of these files"});
    merged.push_back(folder / (out + "/runs.jsonl"));
  }
  const Outcome outcome = ended_with(0, merged);
  EXPECT_TRUE(outcome.out.ends_with("4 of 4 printed figures agree\n")) << outcome.out;
  expect_same("merged", "one");
}

/// What was run belongs to a scene, not to its name.
TEST_F(DividedStudy, RunsAgainWhatHasChanged) {
  ended_with(0, work("out"));
  std::string scene = text("scene.toml");
  write("scene.toml", scene.replace(scene.find("[0, 1]"), 6, "[0, 2]"));
  ended_with(1, work("out"));  // the figures are others
  EXPECT_EQ(lines_of(runs_of("out")).size(), 16u);
}

/// What can be written is, when a run of another study fails.
TEST_F(StudyCommand, WritesWhatIsCompleteIfARunFails) {
  const std::string other = folder / "other";
  fs::copy(path, other);
  write("scene.toml", fall());
  replace("until = 1", "until = 2");
  const Outcome outcome = ended_with(3, {"study", other, path, "--jobs", "1"});
  EXPECT_EQ(outcome.out, "");
  expect_words(text_of(other + "/results/double/table.csv"), {figure(1)});
  EXPECT_EQ(text("results/double/table.csv"), "");
}

TEST_F(StudyCommand, RefusesBadInput) {
  expect_refused({"study"}, {"folders"});
  expect_refused({"study", folder / "none"}, {"none"});
  expect_refused({"study", path, folder / "none"}, {"none"});
  expect_refused({"study", path, "--precision", "half"}, {"half"});
  expect_refused({"study", path, "--bogus"}, {"--bogus"});
  expect_refused({"study", path, "--jobs", "0"}, {"--jobs"});
  expect_refused({"study", path, "--shard", "1/2"}, {"--out", "runs.jsonl"});
  expect_refused({"study", path, "--shard", "3/2", "--out", folder / "out"}, {"--shard", "3/2"});
  expect_refused({"study", path, "--out", "/proc/nowhere"}, {"/proc/nowhere"});
  fs::create_directory(folder / "elsewhere");
  fs::copy(path, folder / "elsewhere/small");
  expect_refused({"study", path, folder / "elsewhere/small", "--out", folder / "out"}, {"the same name"});
  fs::remove(path + "/expected.csv");
  expect_refused({"study", path, "--check"}, {"expected.csv"});
  write("expected.csv", "k,s,i,e_y\n1,1,1\n");
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
  const Outcome outcome = ended_with(3, {"study", path});
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(lines_of(outcome.err).size(), 1u) << outcome.err;
}

}  // namespace
}  // namespace hbvm::core
