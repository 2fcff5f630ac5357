#include "cli/json.hpp"
#include "cli/program.hpp"
#include "scalar/literal.hpp"
#include "scene/scene.hpp"

namespace hbvm::core {
namespace {

using Json = nlohmann::json;

/// Off the circle and with a velocity along the rod.
std::string inconsistent_pendulum() {
  std::string text = pendulum("1");
  return text.replace(text.find("[0, -1]"), 7, "[0.9, -1.2]");
}

/// Its rod once more.
std::string with_two_rods(const std::string& scene) {
  const std::size_t rod = scene.find("[[constraint]]");
  return scene + scene.substr(rod, scene.find("[[effect]]") - rod);
}

TEST(SceneCheck, ExplainsEverySceneThatIsShipped) {
  for (const auto& [name, text] : built_in_scenes()) {
    const Outcome outcome = ended_with(0, {"scene", "check", name});
    EXPECT_EQ(outcome.err, "");
    EXPECT_TRUE(outcome.out.starts_with(name + ": ")) << outcome.out;
    expect_words(outcome.out, {"degrees of freedom", "energy H", "L_z"});
  }
}

TEST(SceneCheck, ReadsAFileInThePrecisionAsked) {
  const Folder folder;
  const std::string path = folder.write("scene.toml", pendulum("\"2^(1/4)\""));
  // H = sqrt(2)/2 - 1
  for (const auto& [precision, H] :
       {std::pair("double", "-0.29289321881345"), {"mpfr:40", "-0.29289321881345247559915"}})
    expect_words(hbvm({"scene", "check", path, "--precision", precision}).out, {H});
}

TEST(SceneCheck, IsAlsoJson) {
  const Json json = Json::parse(ended_with(0, {"scene", "check", "kepler", "--json", "--precision", "30"}).out);
  EXPECT_EQ(json.at("scene"), "kepler");
  EXPECT_EQ(json.at("degrees_of_freedom"), 2);
  EXPECT_EQ(json.at("constraints"), Json::array());
}

TEST(SceneCheck, SaysOnWhomEffectsAct) {
  const Folder folder;
  const std::string scene = R"(dimension = 3
point = [{ name = "Earth", position = [0, 0, 0] }]
body = [{ name = "probe", mass = 20, position = [8, 0, 0], velocity = [0, 1, 0] }]
effect = [{ kind = "central_gravity", center = "Earth", strength = 3 },
          { kind = "trap", center = "Earth", stiffness = 3, exponent = 2, on = ["probe"] }]
[[rigid_body]]
name = "sat"
position = [7, 0, 0]
velocity = [0, 1, 0]
mass = 500
center = [0, 0, 0]
second_moment = [[3e-4, 0, 0], [0, 2e-4, 0], [0, 0, 1e-4]]
directors = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
angular_velocity = [0, 0, 0]
)";
  const std::string report = hbvm({"scene", "check", folder.write("scene.toml", scene)}).out;
  expect_words(report, {"central_gravity, 2 in all", "on                  'probe', 'sat'\n",
                        "rigid bodies at the centre of mass, the change of the field across them neglected",
                        "not on              'sat' (not named)", "'sat'               inertia 0.0003, 0.0004, 0.0005"});
}

/// A start that a projection in double made is taken with more digits, and said to be moved.
TEST(SceneProject, InDoubleServesMoreDigits) {
  const Folder folder;
  const std::string from = folder.write("from.toml", inconsistent_pendulum()), to = folder / "to.toml";
  ended_with(0, {"scene", "project", from, "--out", to});
  expect_words(ended_with(0, {"scene", "check", to, "--precision", "60"}).out, {"to its own 1"});
  const Arguments run = run_of(to, "hbvm:3,3", "1/8", "1") + Arguments{"--precision", "mpfr:30"};
  expect_words(ended_with(0, run).out, {"the start is consistent to its own 1"});
  expect_words(hbvm(run + Arguments{"--json"}).out, {"\"start_settled\""});
}

TEST(SceneCheck, RefusesBadInput) {
  const Folder folder;
  expect_refused({"scene"}, {"subcommand"});
  expect_refused({"scene", "chekc", "kepler"}, {"chekc"});
  expect_refused({"scene", "check"}, {"scene"});
  expect_refused({"scene", "check", "keplr"}, {"'keplr'", "'kepler'"});
  expect_refused({"scene", "check", "kepler", "more"}, {"more"});
  expect_refused({"scene", "check", "kepler", "--precision", "mpfr:5"}, {"precision"});
  expect_refused({"scene", "check", "kepler", "--out", "x"}, {"--out"});
  expect_refused({"scene", "check", folder.write("bad.toml", "dimension = 4\n")}, {"bad.toml:1", "'dimension'"});
  expect_refused({"scene", "check", folder.write("off.toml", inconsistent_pendulum())},
                 {"off.toml", "position", "rod", "1.25e+00", "hbvm scene project"});
  std::string twice = with_two_rods(pendulum("1"));
  const std::string report = hbvm({"scene", "check", folder.write("twice.toml", twice)}).out;
  expect_words(report, {"constraints nu        1\n", "  redundant", "constraint 2 (rod", "follows from constraint 1"});
  twice.replace(twice.rfind("length = 1"), 10, "length = 2");
  expect_refused({"scene", "check", folder.write("twice.toml", twice)},
                 {"constraint 2", "contradictory", "constraint 1", "-3.00e+00"});
}

TEST(SceneProject, WritesASceneThatChecks) {
  const Folder folder;
  const std::string from = folder.write("from.toml", inconsistent_pendulum()), to = folder / "to.toml";
  for (const char* precision : {"double", "quad", "mpfr:60"}) {
    const Outcome outcome = ended_with(0, {"scene", "project", from, "--precision", precision, "--out", to});
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(outcome.err, written({to}));
    ended_with(0, {"scene", "check", to, "--precision", precision});
    ended_with(0, run_of(to, "hbvm:1,1", "1/8", "1/8") + Arguments{"--precision", precision});
    // The nearest point of the circle is (3, -4)/5; (1, 0) loses 3/5 of (3, -4)/5.
    const Scene scene = load_scene(to);
    const double position[2] = {0.6, -0.8}, velocity[2] = {0.64, 0.48};
    for (std::size_t j = 0; j < 2; ++j) {
      EXPECT_NEAR(evaluate<double>(scene.bodies[0].position[j]), position[j], 1e-15);
      EXPECT_NEAR(evaluate<double>(scene.bodies[0].velocity[j]), velocity[j], 1e-15);
    }
  }
  EXPECT_EQ(text_of(from), inconsistent_pendulum());
}

TEST(SceneProject, PrintsTheSceneWithoutAFile) {
  const Folder folder;
  const std::string from = folder.write("from.toml", inconsistent_pendulum()), to = folder / "to.toml";
  const std::string printed = ended_with(0, {"scene", "project", from}).out;
  ended_with(0, {"scene", "project", from, "--out", to});
  EXPECT_EQ(printed, text_of(to));
  EXPECT_EQ(read_scene(printed, "printed").title, "Pendulum");
}

TEST(SceneProject, KeepsComments) {
  const Folder folder;
  std::string text = inconsistent_pendulum();
  text.insert(0, "# of mine\n");
  text.insert(text.find("mass = 1") + 8, "  # kilograms");
  const std::string projected = hbvm({"scene", "project", folder.write("from.toml", text)}).out;
  EXPECT_TRUE(projected.starts_with("# of mine\n"));
  expect_words(projected, {"mass = 1  # kilograms\n"});
}

TEST(SceneProject, RefusesBadInput) {
  const Folder folder;
  const std::string good = folder.write("good.toml", inconsistent_pendulum());
  std::string text = with_two_rods(inconsistent_pendulum());
  text.replace(text.rfind("length = 1"), 10, "length = 2");
  expect_refused({"scene", "project", folder.write("twice.toml", text)}, {"twice.toml", "no consistent position"});
  expect_refused({"scene", "project"}, {"scene"});
  expect_refused({"scene", "project", "keplr"}, {"'kepler'"});
  expect_refused({"scene", "project", good, "--precision", "octuple"}, {"precision"});
  expect_refused({"scene", "project", good, "--out"}, {"--out"});
  expect_refused({"scene", "project", good, "--out", ""}, {"--out"});
  expect_refused({"scene", "project", good, "--out", "/nonexistent/to.toml"}, {"'/nonexistent/to.toml'"});
  expect_refused({"scene", "project", good, "--out", folder / "."}, {folder / "."});
  expect_refused({"scene", "project", good, "--out", "/dev/full"}, {"/dev/full"});
}

TEST(SceneProject, LeavesTheFileAloneIfItFails) {
  const Folder folder;
  const std::string precious = folder.write("precious.toml", "precious");
  expect_refused({"scene", "project", "keplr", "--out", precious}, {"keplr"});
  EXPECT_EQ(text_of(precious), "precious");
}

TEST(SceneProject, HoldsWhatItIsAskedTo) {
  const Folder folder;
  const std::string from = folder.write("from.toml", inconsistent_pendulum());
  const std::string printed = ended_with(0, {"scene", "project", from, "--hold", "bob.x,bob.vx"}).out;
  const std::string free = ended_with(0, {"scene", "project", from}).out;
  EXPECT_NE(printed, free);
  expect_refused({"scene", "project", from, "--hold", "bob.z"},
                 {"'bob.z' is nothing that can be held", "did you mean"});
}

/// What it prints runs as it stands.
TEST(SceneNew, IsASceneThatRuns) {
  const Folder folder;
  const std::string text = ended_with(0, {"scene", "new"}).out, file = folder.write("mine.toml", text);
  expect_words(text, {"# A scene says what there is", "[[rigid_body]]"});
  expect_words(ended_with(0, {"run", file, "--until", "1"}).out, {"A pendulum", "tension", "no warning"});
  // The tables that are remarks are right, too.
  std::string all, line;
  bool in_table = false;
  for (std::istringstream lines(text); std::getline(lines, line);) {
    in_table = line.starts_with("# [[") || (in_table && line.starts_with("# "));
    all += (in_table ? line.substr(2) : line) + "\n";
  }
  EXPECT_EQ(read_scene(all, "all").rigid_bodies.size(), 1u);
  EXPECT_EQ(read_scene(all, "all").constraints.size(), 2u);
}

/// So that one sees what is wrong.
TEST(SceneShow, DrawsAStartThatIsNotConsistent) {
  const Folder folder;
  const std::string file = folder / "off.svg";
  const Outcome outcome =
      ended_with(0, {"scene", "show", folder.write("off.toml", inconsistent_pendulum()), "--plot", file});
  expect_words(outcome.err, {"off.svg", "off.toml", "not consistent", "hbvm scene project"});
  expect_words(text_of(file), {"(the start is not consistent)"});
}

TEST(SceneShow, DrawsAScene) {
  const Folder folder;
  for (const char* const name : {"four_bar_linkage", "heavy_top", "charged_tetrahedron"}) {
    const std::string file = folder / (std::string(name) + ".svg");
    EXPECT_EQ(ended_with(0, {"scene", "show", name, "--plot", file}).err, written({file}));
    expect_words(text_of(file), {"Start"});
  }
  expect_refused({"scene", "show", "four_bar_linkage", "--plot", folder / "a.gif"}, {".svg", "a.gif"});
}

}  // namespace
}  // namespace hbvm::core
