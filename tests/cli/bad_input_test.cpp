#include <gtest/gtest.h>

#include "cli/program.hpp"

namespace hbvm::core {
namespace {

/// A run of `scene` with one option replaced.
Arguments run_with(const std::string& option, const std::string& value, const std::string& scene = "simple_pendulum") {
  Arguments arguments{"run", scene};
  for (const auto& [name, usual] : std::vector<std::pair<std::string, std::string>>{
           {"--method", "hbvm:2,2"}, {"--step", "0.1"}, {"--until", "1"}, {"--precision", "double"}})
    if (name != option) arguments = arguments + Arguments{name, usual};
  return option.empty() ? arguments : arguments + Arguments{option, value};
}
Arguments usual_run(const std::string& scene) { return run_with("", "", scene); }

/// A pendulum's scene with something else in place of `from`.
std::string other_pendulum(const std::string& from, const std::string& to) {
  std::string text = pendulum("1");
  return text.replace(text.find(from), from.size(), to);
}

TEST(BadScene, Unknown) {
  expect_refused(usual_run("no_such_scene"), {"unknown scene", "'no_such_scene'"});
  expect_refused(usual_run("simple_pendulm"), {"'simple_pendulm'", "'simple_pendulum'"});
  expect_refused(usual_run("/nonexistent/scene.toml"), {"/nonexistent/scene.toml"});
  expect_refused(usual_run(""), {"scene"});
  expect_refused(usual_run("/tmp"), {"/tmp"});
}

TEST(BadScene, Malformed) {
  const Folder folder;
  const auto refused = [&](const std::string& toml, int line, const std::vector<std::string>& words) {
    const std::string path = folder.write("scene.toml", toml);
    std::vector<std::string> all = words;
    all.push_back(path + ":" + std::to_string(line));
    expect_refused(usual_run(path), all);
  };
  refused("", 1, {"dimension"});
  refused(other_pendulum("mass = 1", "mas = 1"), 10, {"'mas'", "'mass'"});
  refused(other_pendulum("mass = 1", "mass = "), 10, {});
  refused(other_pendulum("mass = 1", "mass = -1"), 8, {"'bob'", "mass"});
  refused(other_pendulum("mass = 1", "mass = \"1/0\""), 8, {"'bob'", "division"});
  refused(other_pendulum("mass = 1", "mass = [[1, 2], [3, 4]]"), 8, {"'bob'", "symmetric"});
  refused(other_pendulum("\"rod\"", "\"rood\""), 14, {"'rod'"});
  refused(other_pendulum("\"O\", \"bob\"", "\"O\", \"bib\""), 14, {"'bib'", "'bob'"});
  refused(other_pendulum("uniform_gravity", "gravity"), 19, {"gravity"});
  refused(other_pendulum("Pendulum", "Pendulum\xFF"), 1, {});
  refused(other_pendulum("Pendulum", "Pendu\xEF\xBB\xBFlum"), 1, {"U+FEFF"});
}

/// Whatever line breaks the input holds.
TEST(Messages, AreOneLine) {
  const Folder folder;
  const auto with = [&](const std::string& from, const std::string& to) {
    return folder.write("scene.toml", other_pendulum(from, to));
  };
  expect_refused(usual_run("two\nlines"), {"unknown scene"});
  expect_refused(usual_run(with("\"rod\"", "\"ro\\nd\"")), {"'rod'"});
  expect_refused(usual_run(with("mass = 1", "mass = \"\"\"1\n+\"\"\"")), {"'mass'"});
  expect_refused(usual_run(with("\"O\", \"bob\"", "\"O\", \"bo\\nb\"")), {"'bob'"});
  expect_refused(run_with("--method", "hbvm:2\n,2"), {"method"});
  expect_refused(run_with("--step", "\n"), {"step"});
  expect_refused(run_with("--step", "0.\n1"), {"step"});
  expect_refused(run_with("--until", "1\n+"), {"until"});
  expect_refused(run_with("--precision", "quad\n"), {"precision"});
  expect_refused(run_with("--solver", "pa\nper"), {"solver"});
  expect_refused(run_with("--out", "/nonexistent/two\nlines"), {"/nonexistent"});
  expect_refused(run_with("--bogus\n", "1"), {"--bogus"});
}

TEST(BadScene, OfHugeNesting) {
  const Folder folder;
  std::string text = "a";
  for (int i = 0; i < 100'000; ++i) text += ".a";
  const std::string path = folder.write("deep.toml", text + " = 1\n");
  expect_refused(usual_run(path), {path + ":1"});
}

TEST(BadScene, InconsistentStartNamesConstraintAndResidual) {
  const Folder folder;
  const auto with = [&](const std::string& from, const std::string& to) {
    return folder.write("scene.toml", other_pendulum(from, to));
  };
  expect_refused(usual_run(with("length = 1", "length = 2")),
                 {"position", "rod", "'O'", "'bob'", "residual -3.00e+00"});
  expect_refused(usual_run(with("[1, 0]", "[1, 0.25]")), {"velocity", "rod", "'O'", "'bob'", "residual -5.00e-01"});
  expect_refused(run_with("--precision", "mpfr:50", with("[0, -1]", "[1e-17, -1]")), {"position", "rod", "1.00e-34"});
}

TEST(BadMethod, IsRefused) {
  for (const char* method : {"hbvm:1,2", "hbvm:2,0", "hbvm:0,0", "hbvm:3,-1", "hbvm:100000,1"})
    expect_refused(run_with("--method", method), {method});
  for (const char* method : {"", "gauss", "hbvm", "hbvm:", "hbvm:2", "hbvm:2,", "hbvm:,2", "hbvm:2,2,1", "hbvm:2.5,2",
                             "hbvm: 2,2", "HBVM:2,2", "hbvm:2,2 ", "hbvm:99999999999999999999,1", "hbvm:a,b"})
    expect_refused(run_with("--method", method), {"method"});
}

/// Briefly: what there is, or what it is called here.
TEST(BadMethod, OfAnotherNameIsKnownOrListed) {
  expect_refused(run_with("--method", "verlets"), {"unknown method 'verlets': did you mean 'verlet'?"});
  expect_refused(run_with("--method", "rk4:5"),
                 {"method rk4 takes no arguments but +project, +baumgarte:ALPHA,BETA or +ggl, and has '5'"});
  expect_refused(run_with("--method", "rattel"), {"did you mean 'rattle'?"});
  expect_refused({"audit", "--method", "rattel"}, {"unknown method 'rattel': did you mean 'rattle'?"});
  EXPECT_LT(hbvm(run_with("--method", "adams")).err.size(), 250u);
}

TEST(BadTimes, OfAStepAreRefused) {
  for (const char* step :
       {"",    "abc", "0.1.1", "1/",   "(1",  "1)",     "2^",       "0,1",    "0x10",  "1 2",      "0",    "-0.1",
        "1-1", "nan", "inf",   "-inf", "1/0", "log(0)", "sqrt(-1)", "1e-400", "1e400", "exp(1e9)", "1e-13"})
    expect_refused(run_with("--step", step), {"step"});
}

TEST(BadTimes, OfAnEndAreRefused) {
  for (const char* until :
       {"", "abc", "1..1", "1/", "(1", "1)", "0", "-1", "1-1", "nan", "inf", "1/0", "1e400", "1e-400"})
    expect_refused(run_with("--until", until), {"until"});
}

/// A run says what its last step became. What measures orders, or proves steps, takes equal ones.
TEST(BadTimes, WhereTheStepDoesNotDivideShortenTheLast) {
  for (const char* step : {"0.3", "2", "1/3 + 1e-12", "pi", "1e10"})
    expect_words(ended_with(0, run_with("--step", step)).out, {"the last shortened to"});
  expect_refused(run_with("--step", "0.3") + Arguments{"--prove"}, {"step", "divide"});
  expect_refused({"convergence", "simple_pendulum", "--methods", "rk4", "--steps", "3/10:3/160", "--until", "1"},
                 {"divide"});
}

TEST(BadPrecision, IsRefused) {
  for (const char* precision : {"", "float", "Double", "mpfr", "mpfr:", "mpfr:19", "mpfr:10001", "mpfr:-50", "mpfr:5e1",
                                "mpfr:50.5", "mpfr:abc", "mpfr:99999999999999999999", "quad:34", "double "}) {
    expect_refused(run_with("--precision", precision), {"precision"});
    expect_refused({"nodes", "5", "--precision", precision}, {"precision"});
  }
}

TEST(BadSolver, IsRefused) {
  for (const char* solver : {"", "paperr", "PAPER", "fixed point"})
    expect_refused(run_with("--solver", solver), {"solver"});
}

TEST(BadOnFailure, IsRefused) {
  for (const char* action : {"", "retry", "HALVE", "halve "})
    expect_refused(run_with("--on-failure", action), {"--on-failure", "stop or halve"});
}

TEST(BadOutput, UnwritableIsRefused) {
  const Folder folder;
  expect_refused(run_with("--out", "/nonexistent/trajectory.csv"), {"'/nonexistent/trajectory.csv'"});
  expect_refused(run_with("--out", folder / "."), {folder / "."});
  expect_refused(run_with("--out", ""), {"--out"});
  expect_refused(run_with("--out", "/dev/full"), {"/dev/full"});
}

TEST(BadOutput, OfADashIsNoFile) {
  for (const char* option : {"--out", "--plot", "--checkpoint"})
    expect_refused(run_with(option, "-"), {option, "name a file"});
  expect_refused({"audit", "--out", "-"}, {"--out", "name a file"});
}

/// The second of two at once ends, and leaves the first one's file alone.
TEST(BadOutput, ThatAnotherRunWritesIsRefused) {
  const Folder folder;
  const std::string csv = folder / "both.csv";
  const Arguments run = run_of("kepler", "hbvm:3,2", "1/1000", "1e6") + Arguments{"--out", csv};
  const Outcome first = hbvm(run, 60, [&](pid_t child) {
    while (!std::filesystem::exists(csv)) usleep(1'000);
    const Outcome second = hbvm(run);
    EXPECT_EQ(second.code, 2);
    EXPECT_EQ(second.err,
              "hbvm: --out: '" + csv + "' is being written by another run; wait for its end, or name another\n");
    kill(child, SIGTERM);
  });
  EXPECT_EQ(first.code, 128 + SIGTERM);
}

TEST(BadOutput, IsSeenBeforeLongComputations) {
  expect_refused(run_of("simple_pendulum", "hbvm:200,200", "0.1", "1e6") + Arguments{"--out", "/nonexistent/t.csv"},
                 {"'/nonexistent/t.csv'"});
}

TEST(BadOutput, IsNotOpenedForAnotherMistake) {
  const Folder folder;
  const std::string path = folder.write("precious.csv", "precious");
  expect_refused(run_with("--step", "-1") + Arguments{"--out", path}, {"step"});
  expect_refused(run_with("--method", "hbvm:1,2") + Arguments{"--out", path}, {"hbvm:1,2"});
  expect_refused(run_with("--precision", "quadd") + Arguments{"--out", path}, {"quadd"});
  EXPECT_EQ(text_of(path), "precious");
}

TEST(BadOutput, DoesNotOverwriteTheScene) {
  const Folder folder;
  const std::string path = folder.write("scene.toml", pendulum("1"));
  expect_refused(run_with("--out", path, path), {path});
  EXPECT_EQ(text_of(path), pendulum("1"));
}

TEST(BadEvery, IsRefused) {
  for (const char* every : {"0", "-1", "abc", "1.5", "", "99999999999999999999"})
    expect_refused(run_with("--every", every), {"every"});
}

TEST(BadNodes, OutOfRangeAreRefused) {
  for (const char* n : {"0", "-1", "10001", "99999999999", "abc", "5.5", "1e3", ""}) expect_refused({"nodes", n}, {});
  expect_refused({"nodes", "0"}, {"n = 0"});
  expect_refused({"nodes", "10001"}, {"10001", "10000"});
}

TEST(Misuse, OfAnUnknownSubcommandOrOptionNamesIt) {
  expect_refused({"simulate"}, {"simulate"});
  expect_refused({"runn", "simple_pendulum"}, {"runn"});
  expect_refused({"--bogus"}, {"--bogus"});
  expect_refused({"--json"}, {"--json"});
}

TEST(Misuse, OfTheCommandLineIsRefused) {
  expect_refused({}, {"subcommand"});
  expect_refused({"run"}, {"scene"});
  expect_refused({"run", "simple_pendulum"}, {"--until"});
  expect_refused({"run", "simple_pendulum", "--method", "hbvm:2,2", "--step", "1"}, {"--until"});
  expect_refused(run_with("--step", "0.1") + Arguments{"--bogus"}, {"--bogus"});
  expect_refused(run_with("--step", "0.1") + Arguments{"conical_pendulum"}, {"conical_pendulum"});
  expect_refused(run_with("--step", "0.1") + Arguments{"--step", "0.2"}, {"--step"});
  expect_refused(run_with("--step", "0.1") + Arguments{"--out"}, {"--out"});
  expect_refused({"run", "simple_pendulum", "--method"}, {"--method"});
  expect_refused({"nodes"}, {"N"});
  expect_refused({"nodes", "5", "6"}, {"6"});
  expect_refused({"nodes", "5", "--precision"}, {"--precision"});
  expect_refused({"nodes", "5", "--step", "1"}, {"--step"});
  expect_refused({"scenes", "more"}, {"more"});
  expect_refused({"scenes", "--bogus"}, {"--bogus"});
}

}  // namespace
}  // namespace hbvm::core
