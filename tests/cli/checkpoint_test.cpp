#include <gtest/gtest.h>

#include <random>
#include <thread>

#include "checksum.hpp"
#include "cli/json.hpp"
#include "cli/program.hpp"
#include "csv_line.hpp"
#include "printing.hpp"
#include "scalar/literal.hpp"
#include "scalar/with_scalar.hpp"

namespace hbvm::core {
namespace {

using nlohmann::ordered_json;

/// A run whose carries and extrapolations matter: up to 400 it takes about half a second of processor time.
Arguments long_run(long until = 400) {
  return run_of("charged_double_pendulum", "hbvm:6,3", "1/256", std::to_string(until));
}

/// What is printed of a run, its time apart.
ordered_json result_of(const Arguments& arguments) {
  ordered_json j = ordered_json::parse(ended_with(0, arguments).out, nullptr, false);
  EXPECT_TRUE(j.is_object());
  if (j.is_object()) j.erase("cpu_seconds");
  return j;
}
ordered_json resumed(const std::string& checkpoint) { return result_of({"run", "--resume", checkpoint}); }

/// As many cells in each line of a trajectory as there are names.
void expect_complete_lines(const std::string& csv) {
  ASSERT_FALSE(csv.empty());
  EXPECT_EQ(csv.back(), '\n');
  const auto lines = lines_of(csv);
  for (const std::string& line : lines)
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), std::count(lines[0].begin(), lines[0].end(), ','));
}

/// Waits until the file is there and larger than `size`; it is not if the program ends before.
void await(pid_t program, const std::string& path, std::uintmax_t size = 0) {
  const auto is_there = [&] {
    std::error_code ignored;
    return std::filesystem::exists(path, ignored) && std::filesystem::file_size(path, ignored) > size;
  };
  const auto has_ended = [program] {
    siginfo_t of{};
    return waitid(P_PID, static_cast<id_t>(program), &of, WEXITED | WNOHANG | WNOWAIT) == 0 && of.si_pid == program;
  };
  while (!is_there() && !has_ended()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_TRUE(is_there()) << path << " does not grow";
}

/// A run that is killed as soon as its checkpoint is there.
void begin_and_kill(const Arguments& run, const std::string& checkpoint) {
  hbvm(run, 60, [&](pid_t program) {
    await(program, checkpoint);
    kill(program, SIGKILL);
  });
  ASSERT_TRUE(std::filesystem::exists(checkpoint)) << "it ends without a checkpoint";
}

TEST(Checkpoint, OfARunThatIsKilledAgainAndAgainLeadsToTheSameBytes) {
  const Folder folder;
  const std::string whole = folder / "whole.csv", kept = folder / "kept.csv", file = folder / "run.checkpoint";
  const Arguments run = long_run() + Arguments{"--json", "--every", "7", "--out"};
  const ordered_json expected = result_of(run + Arguments{whole});
  begin_and_kill(run + Arguments{kept, "--checkpoint", file, "--every-seconds", "0.01"}, file);
  std::mt19937 random(5);
  std::uniform_int_distribution<long> time(1, 40'000);
  int killed = 0;
  for (int i = 0; i < 20; ++i) killed += hbvm_killed_after(time(random), {"run", "--resume", file}).code == -SIGPROF;
  EXPECT_GE(killed, 5);
  EXPECT_EQ(resumed(file).dump(), expected.dump());
  EXPECT_TRUE(text_of(kept) == text_of(whole));
  ordered_json described = ordered_json::parse(text_of(kept + "-metadata.json"));
  EXPECT_EQ(described["url"], "kept.csv");
  described["url"] = "whole.csv";
  EXPECT_EQ(described.dump(2) + "\n", text_of(whole + "-metadata.json"));
  // And once more from the end.
  EXPECT_EQ(resumed(file).dump(), expected.dump());
}

/// k is raised and steps are divided where the body passes the center; the shadow sees states of all parts of the run.
TEST(Checkpoint, KeepsWhatRaisedNodesDividedStepsAndTheShadowRemember) {
  const Folder folder;
  const std::string file = folder / "run", scene = folder.write("passing.toml", R"(
dimension = 2
point = [{ name = "O", position = [0, 0] }]
body = [{ name = "a", mass = 1, position = [-16, "1/8"], velocity = [2, 0] }]
effect = [{ kind = "central_gravity", center = "O", strength = 1 }]
)");
  const Arguments run = run_of(scene, "hbvm:auto,2", "1/4", "16") +
                        Arguments{"--json", "--on-failure", "halve", "--shadow", "--solver", "fixed-point"};
  const ordered_json expected = result_of(run);
  EXPECT_GT(expected["halved"]["steps"], 0);
  EXPECT_FALSE(expected["chosen"]["raised"].empty());
  begin_and_kill(run + Arguments{"--checkpoint", file, "--every-seconds", "0"}, file);
  for (int i = 0; i < 100; ++i) {
    const Arguments resume{"run", "--resume", file};
    const Outcome outcome =
        i % 2 == 0 ? hbvm_killed_after(5'000 + 1'000 * i, resume) : hbvm(resume, 60, [&](pid_t program) {
          std::this_thread::sleep_for(std::chrono::milliseconds(5 + i));
          kill(program, SIGTERM);
        });
    if (outcome.code == 0) break;
  }
  EXPECT_EQ(resumed(file).dump(), expected.dump());
}

TEST(Checkpoint, ContinuesTheAccount) {
  const Folder folder;
  for (const char* precision : {"quad", "double"}) {
    const std::string file = folder / precision;
    const Arguments run = run_of("kepler", "hbvm:auto,2", "1/64", "16") +
                          Arguments{"--json", "--precision", precision, "--account", "--solver", "newton"};
    ordered_json whole = result_of(run);
    hbvm(run + Arguments{"--checkpoint", file, "--every-seconds", "0"}, 60, [&](pid_t program) {
      await(program, file);
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      kill(program, SIGTERM);
    });
    ordered_json again = resumed(file);
    for (ordered_json* j : {&whole, &again})
      for (ordered_json& line : (*j)["account"]) line.erase("seconds");
    EXPECT_EQ(again.dump(), whole.dump());
  }
}

TEST(Signals, EndARunWithCompleteLines) {
  for (const int signal : {SIGINT, SIGTERM}) {
    for (const bool keep : {false, true}) {
      // Twice as long a run if one ends before it is told to.
      for (long until = 400, code = 0; code == 0; until *= 2) {
        const Folder folder;
        const std::string csv = folder / "t.csv", file = folder / "run";
        const Arguments run =
            long_run(until) + Arguments{"--out", csv} + (keep ? Arguments{"--checkpoint", file} : Arguments());
        const Outcome outcome = hbvm(run, 60, [&](pid_t program) {
          await(program, csv, 10'000);
          kill(program, signal);
        });
        code = outcome.code;
        if (code == 0) continue;
        EXPECT_EQ(code, 128 + signal);
        EXPECT_EQ(outcome.out, "");
        EXPECT_TRUE(outcome.err.starts_with(written(with_metadata(csv)) + "hbvm: ")) << outcome.err;
        EXPECT_EQ(lines_of(outcome.err).size(), 3u) << outcome.err;
        expect_words(outcome.err, {signal == SIGINT ? "SIGINT" : "SIGTERM",
                                   keep ? "hbvm run --resume " + file : std::string("--checkpoint")});
        expect_complete_lines(text_of(csv));
        EXPECT_EQ(std::filesystem::exists(file), keep);
        if (!keep) continue;
        EXPECT_EQ(hbvm({"run", "--resume", file}).code, 0);
        EXPECT_EQ(lines_of(text_of(csv)).size(), static_cast<std::size_t>(1 + 256 * until + 1));
      }
    }
  }
}

/// Each would take from twenty seconds to hours.
TEST(Signals, EndWhatTakesLong) {
  for (const Arguments& arguments :
       {Arguments{"audit", HBVM_SOURCE_DIR "/studies/atlas"},
        {"audit", "--command", "sleep 3600 # {scene} {step} {until} {out}", "--limit", "0"},
        {"tangent", "chaotic_double_pendulum", "--method", "hbvm:4,4", "--step", "1/8", "--until", "1000000"},
        {"run", "chaotic_double_pendulum", "--step", "1/8", "--until", "1000000", "--event", "up: a.vx"},
        {"run", "chaotic_double_pendulum", "--step", "1/8", "--until", "10000", "--precision", "400", "--horizon"},
        {"section", "henon_heiles", "--plane", "star.x", "--axes", "star.y", "star.vy", "--step", "1/8", "--until",
         "1000000"},
        {"periodic", "four_bars_10", "--until", "100"}}) {
    const Outcome outcome = hbvm(arguments, 60, [](pid_t program) {
      std::this_thread::sleep_for(std::chrono::seconds(2));
      kill(program, SIGINT);
    });
    EXPECT_EQ(outcome.code, 128 + SIGINT) << ::testing::PrintToString(arguments) << outcome.err;
  }
}

/// They take about 0.1 s each. The run stands still while its lines are counted before the signal.
TEST(Signals, DoNotWaitForABlockOfSlowSteps) {
  const Folder folder;
  const std::string csv = folder / "t.csv";
  const auto lines = [&] { return lines_of(text_of(csv)).size(); };
  std::size_t before = 0;
  const Arguments run = run_of("triple_pendulum", "hbvm:40,20", "1/4", "1000") +
                        Arguments{"--precision", "mpfr:500", "--out", csv, "--checkpoint", folder / "run"};
  const Outcome outcome = hbvm(run, 60, [&](pid_t program) {
    await(program, folder / "run");
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    kill(program, SIGSTOP);
    int status = 0;
    waitpid(program, &status, WUNTRACED);
    before = lines();
    kill(program, SIGTERM);
    kill(program, SIGCONT);
  });
  EXPECT_EQ(outcome.code, 143) << outcome.err;
  EXPECT_LT(lines(), before + 64u);
}

class Kept : public ::testing::Test {
 protected:
  /// A run of some steps with a checkpoint and a trajectory.
  void SetUp() override {
    ended_with(0, run_ + Arguments{"--out", csv_, "--checkpoint", file_});
    text_ = text_of(file_);
  }
  void refused(const Arguments& more, const std::vector<std::string>& words) const {
    const std::string csv = text_of(csv_), kept = text_of(file_);
    expect_refused(Arguments{"run", "--resume", file_} + more, words);
    EXPECT_EQ(text_of(csv_), csv);
    EXPECT_EQ(text_of(file_), kept);
  }

  Folder folder_;
  std::string csv_ = folder_ / "t.csv", file_ = folder_ / "run", text_;
  std::string scene_ = folder_.write("scene.toml", pendulum("1"));
  Arguments run_ = run_of(scene_, "hbvm:2,2", "1/8", "4") + Arguments{"--every", "3"};
};

TEST_F(Kept, IsRefusedIfDamaged) {
  const auto damaged = [&](const std::string& text, const std::vector<std::string>& words) {
    folder_.write("run", text);
    refused({}, words);
  };
  std::string flipped = text_;
  flipped[flipped.size() / 2] = static_cast<char>(flipped[flipped.size() / 2] ^ 1);
  damaged(flipped, {file_, "damaged", "checksum"});
  damaged(text_.substr(0, text_.size() / 2), {file_, "damaged", "cut off"});
  damaged("", {file_, "empty"});
  damaged(pendulum("1"), {file_, "no checkpoint"});
  const auto resealed = [](const std::string& text) {
    const std::string contents = text.substr(0, text.rfind("checksum "));
    return contents + "checksum " + Checksum(contents).text() + "\n";
  };
  damaged(resealed("hbvm checkpoint 7" + text_.substr(text_.find('\n'))), {file_, "'7'", "version"});
  std::string other = text_;
  const std::string version = lines_of(hbvm({"--version"}).out).at(0);
  damaged(resealed(other.replace(other.find(version), 1, "9")), {file_, "9" + version.substr(1), version});
  folder_.write("run", text_);
  std::filesystem::remove(file_);
  expect_refused({"run", "--resume", file_}, {file_});
}

TEST_F(Kept, IsRefusedIfForeign) {
  refused({"--method", "hbvm:3,2"}, {"--method hbvm:2,2", "--method hbvm:3,2"});
  refused({"--step", "1/16"}, {"--step 1/8", "--step 1/16"});
  refused({"--until", "8"}, {"--until 4", "--until 8"});
  refused({"--precision", "quad"}, {"--precision double", "--precision quad"});
  refused({"--solver", "newton"}, {"--solver auto", "--solver newton"});
  refused({"--every", "1"}, {"--every 3", "--every 1"});
  refused({"--reverse"}, {"without --reverse", "with --reverse"});
  refused({"--account"}, {"without --account"});
  refused({"--start", scene_}, {"without --start"});
  refused({"kepler"}, {"another scene"});
  refused({folder_.write("other.toml", pendulum("1.5"))}, {"another scene"});
  refused({"--out", folder_ / "none"}, {"--out", folder_ / "none"});
}

TEST_F(Kept, TakesItsCommandAgainOrNoneOrAnotherPathToTheSame) {
  const std::string csv = text_of(csv_);
  const auto goes_on = [&](const Arguments& arguments) {
    ended_with(0, arguments + Arguments{"--resume", file_});
    EXPECT_EQ(text_of(csv_), csv);
  };
  goes_on({"run"});
  goes_on(run_ + Arguments{"--out", csv_, "--checkpoint", file_, "--json"});
  goes_on({"run", folder_.write("copy.toml", pendulum("1")), "--solver", "auto", "--every-seconds", "5"});
  std::filesystem::remove(scene_);
  goes_on({"run"});
  goes_on({"run", "--out", folder_.write("moved.csv", csv)});
}

TEST_F(Kept, IsRefusedIfItsTrajectoryIsGoneOrAnother) {
  const std::string csv = text_of(csv_);
  folder_.write("t.csv", csv.substr(0, csv.size() - 1));
  refused({}, {csv_, std::to_string(csv.size())});
  folder_.write("t.csv", "#" + csv);
  refused({}, {csv_, "begin"});
  folder_.write("t.csv", "");
  refused({}, {csv_});
  std::filesystem::remove(csv_);
  expect_refused({"run", "--resume", file_}, {csv_});
}

TEST_F(Kept, OverwritesNoOtherFile) {
  expect_refused(run_ + Arguments{"--checkpoint", scene_}, {scene_});
  EXPECT_EQ(text_of(scene_), pendulum("1"));
  expect_refused(run_ + Arguments{"--checkpoint", csv_, "--out", csv_}, {csv_});
  expect_refused(run_ + Arguments{"--checkpoint", folder_ / "new", "--out", folder_ / "new"}, {"--out"});
  expect_refused(run_ + Arguments{"--checkpoint", "/nonexistent/run", "--out", csv_}, {"/nonexistent/run"});
  expect_refused(run_ + Arguments{"--checkpoint", folder_ / "."}, {"--checkpoint"});
  expect_refused(run_ + Arguments{"--checkpoint", ""}, {"--checkpoint"});
  expect_refused(run_ + Arguments{"--checkpoint", folder_ / "new", "--out", "/dev/null"}, {"/dev/null"});
  for (const char* seconds : {"-1", "nan", "abc", ""})
    expect_refused(run_ + Arguments{"--checkpoint", file_, "--every-seconds", seconds}, {"--every-seconds"});
}

TEST(FullDisk, EndsTheTrajectoryWithACompleteLine) {
  const Folder folder;
  const std::string csv = folder / "t.csv";
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  rlimit limit = before;
  limit.rlim_cur = 100'001;
  setrlimit(RLIMIT_FSIZE, &limit);
  const Outcome outcome = hbvm(long_run() + Arguments{"--out", csv});
  setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(outcome.out, "");
  expect_words(outcome.err, {csv});
  expect_complete_lines(text_of(csv));
  EXPECT_GT(text_of(csv).size(), 99'000u);
}

TEST(Start, AndReverseComeBackToRoundOff) {
  const Folder folder;
  for (const char* precision : {"double", "quad", "mpfr:50"}) {
    for (const char* method : {"hbvm:3,2", "hbvm:auto,1"}) {
      const std::string csv = folder / "forth.csv", back = folder / "back.csv";
      const Arguments run = run_of("charged_double_pendulum", method, "1/32", "2") +
                            Arguments{"--precision", precision, "--json", "--out"};
      const ordered_json forth = result_of(run + Arguments{csv});
      EXPECT_FALSE(forth.contains("reverse"));
      const std::string there = folder.write("there.json", forth.dump());
      const ordered_json j = result_of(run + Arguments{back, "--start", there, "--reverse"});
      expect_members(j, {{"t", "-2"}, {"until", "2"}, {"reverse", true}});
      const auto start = split_csv_line(lines_of(text_of(csv)).at(1)),
                 first = split_csv_line(lines_of(text_of(back)).at(1));
      EXPECT_EQ(first.at(0), "0");
      EXPECT_EQ(split_csv_line(lines_of(text_of(back)).at(2)).at(0), "-0.03125");
      EXPECT_EQ(split_csv_line(lines_of(text_of(back)).back()).at(0), "-2");
      with_scalar(Precision::parse(precision), [&]<Scalar S>() {
        for (std::size_t i = 0; i < 4; ++i) {
          EXPECT_EQ(forth["q"][i], first[1 + i]);
          EXPECT_EQ(forth["p"][i], first[5 + i]);
          const auto miss = [&](const ordered_json& came, const std::string& from) {
            return magnitude(S(literal<S>(came.get<std::string>()) - literal<S>(from)));
          };
          EXPECT_LE(miss(j["q"][i], start[1 + i]), 200 * epsilon<S>()) << precision << method;
          EXPECT_LE(miss(j["p"][i], start[5 + i]), 200 * epsilon<S>()) << precision << method;
        }
        return 0;
      });
    }
  }
}

TEST(Start, TakesAStateWithItsCarry) {
  const Folder folder;
  const std::string scene = folder.write("pendulum.toml", pendulum("1"));
  const Arguments run = run_of(scene, "hbvm:2,2", "1/64", "1") + Arguments{"--json"};
  ordered_json end = result_of(run);
  EXPECT_EQ(end["q_carry"].size(), 2u);
  EXPECT_EQ(end["p_carry"].size(), 2u);
  const ordered_json with = result_of(run + Arguments{"--start", folder.write("a.json", end.dump())});
  end.erase("q_carry");
  end.erase("p_carry");
  const ordered_json without = result_of(run + Arguments{"--start", folder.write("a.json", end.dump())});
  EXPECT_NE(with.dump(), without.dump());
  for (const std::size_t i : {0u, 1u}) EXPECT_NEAR(number(with["q"][i]), number(without["q"][i]), 1e-14);
}

TEST(Start, MayLeaveTheHiddenConstraintAndIsRefusedOtherwise) {
  const Folder folder;
  const std::string scene = folder.write("pendulum.toml", pendulum("1"));
  const Arguments run = run_of(scene, "hbvm:2,2", "1/8", "1");
  const auto start = [&](const std::string& json) { return run + Arguments{"--start", folder.write("a.json", json)}; };
  ended_with(0, start(R"({"q": ["0", "-1"], "p": ["1", "0.125"]})"));
  ended_with(0, start(R"x({"q": ["sqrt(1/2)", "-sqrt(1/2)"], "p": ["0", "0"]})x"));
  const auto refused = [&](const std::string& json, const std::vector<std::string>& words) {
    const Arguments arguments = start(json);
    std::vector<std::string> all = words;
    all.push_back(arguments.back());
    expect_refused(arguments, all);
  };
  refused("", {"JSON"});
  refused("[1]", {"object"});
  refused(R"({"p": ["1", "0"]})", {"'q'"});
  refused(R"({"q": ["0", "-1"]})", {"'p'"});
  refused(R"({"q": ["0", "-1"], "p": "1"})", {"'p'", "list"});
  refused(R"({"q": ["0", "-1"], "p": [1, "0"]})", {"'p', entry 1", "text"});
  refused(R"({"q": ["0", "-1", "0"], "p": ["1", "0"]})", {"'q'", "3 entries"});
  refused(R"({"q": ["0", "-1"], "p": ["1", "0"], "q_carry": ["0"], "p_carry": ["0", "0"]})",
          {"'q_carry'", "1 entries"});
  refused(R"({"q": ["0", "-1"], "p": ["1", "0"], "q_carry": ["0", "0"]})", {"'p_carry'"});
  refused(R"({"q": ["0", "-1"], "p": ["nan", "0"]})", {"'p', entry 1", "nan"});
  refused(R"({"q": ["0", "-1"], "p": ["1e400", "0"]})", {"'p', entry 1", "range"});
  refused(R"({"q": ["0", "-1.000001"], "p": ["1", "0"]})", {"'q'", "constraint 1", "rod", "residual"});
  refused(R"({"scene": "kepler", "q": ["0", "-1"], "p": ["1", "0"]})", {"'scene'", "kepler"});
  expect_refused(run + Arguments{"--start", folder / "none"}, {folder / "none"});
}

TEST(Start, AndReverseAreKept) {
  const Folder folder;
  const std::string scene = folder.write("pendulum.toml", pendulum("1")), file = folder / "run";
  const std::string start = folder.write("a.json", R"({"q": ["1", "0"], "p": ["0", "1"]})");
  Arguments run;
  // Twice as long a run if one ends before it is told to.
  for (long until = 20, code = 0; code == 0; until *= 2) {
    std::filesystem::remove(file);
    run =
        run_of(scene, "hbvm:3,2", "1/4096", std::to_string(until)) + Arguments{"--start", start, "--reverse", "--json"};
    const Outcome outcome = hbvm(run + Arguments{"--checkpoint", file, "--every-seconds", "0"}, 60, [&](pid_t program) {
      await(program, file);
      kill(program, SIGINT);
    });
    code = outcome.code;
    EXPECT_TRUE(code == 0 || code == 130) << outcome.err;
  }
  const ordered_json whole = result_of(run);
  expect_refused({"run", "--resume", file, "--start", folder.write("b.json", R"({"q": ["1", "0"], "p": ["0", "2"]})")},
                 {"another state"});
  std::filesystem::remove(start);
  EXPECT_EQ(resumed(file).dump(), whole.dump());
}

/// What it tells between its steps would be lost.
TEST(Checkpoint, IsRefusedForWhatItDoesNotKeep) {
  const Folder folder;
  const Arguments run{"run", "kepler", "--step", "1/8", "--until", "1", "--checkpoint", folder / "kept"};
  for (const Arguments& more : {Arguments{"--at", "1/3"}, {"--every-time", "1/3"}, {"--event", "near: planet.y"}})
    expect_refused(run + more, {"--checkpoint", "events"});
}

}  // namespace
}  // namespace hbvm::core
