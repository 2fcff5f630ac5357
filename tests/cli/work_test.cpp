#include "cli/json.hpp"
#include "cli/program.hpp"

namespace hbvm::core {
namespace {

/// A pendulum whose pivot moves, with drag.
const std::string driven = "driven_pendulum";

Arguments run_of(const std::string& method) {
  return {"run", driven, "--method", method, "--step", "1/16", "--until", "1"};
}

TEST(Work, IsInTheJsonOfARun) {
  const nlohmann::ordered_json run = json_of(run_of("hbvm:4,2"));
  EXPECT_LT(std::stod(run.at("e_B").get<std::string>()), 1e-7);
  EXPECT_GT(std::stod(run.at("e_H").get<std::string>()), 1e-2);
  double sum = 0;
  for (const auto& [name, value] : run.at("work").at("by").items()) sum += std::stod(value.get<std::string>());
  EXPECT_NEAR(sum, std::stod(run.at("work").at("total").get<std::string>()), 1e-14);
  EXPECT_EQ(keys_of(run.at("work").at("by")),
            (std::vector<std::string>{"point 'pivot'", "effect 1 (formula)", "effect 2 (drag)"}));
  EXPECT_EQ(run.at("q").size(), 2U);
  EXPECT_FALSE(json_of({"run", "kepler", "--until", "1"}).contains("work"));
}

TEST(Work, IsToldAtTheTerminal) {
  expect_words(ended_with(0, run_of("hbvm:4,2")).out,
               {"H - W off by", "e_B", "work done until the end", "effect 2 (drag)"});
  expect_words(ended_with(0, {"scene", "check", driven}).out,
               {"a force without a potential", "work of", "point 'pivot'"});
}

TEST(Work, MethodsThatCannotDoItSaySo) {
  for (const char* const method : {"rattle", "symplectic_euler", "lobatto:3", "compose:rattle,4", "energy_momentum"})
    expect_refused(run_of(method), {"effect 2 (drag)", "use hbvm:K,S"});
}

TEST(Work, IsNotProved) {
  expect_refused(run_of("hbvm:2,2") + Arguments{"--prove"}, {"forces without a potential"});
  expect_refused({"reference", driven, "--until", "1", "--digits", "10", "--prove"}, {"two routes are compared"});
}

TEST(Work, BeginsAtItsStart) {
  const Folder folder;
  const std::string there = folder.write("there.json", ended_with(0, run_of("hbvm:2,2") + Arguments{"--json"}).out);
  expect_refused(run_of("hbvm:2,2") + Arguments{"--start", there}, {"--start", "begins at t = 0"});
  expect_refused(run_of("taylor") + Arguments{"--precision", "mpfr:30", "--reverse"}, {"taylor", "back in time"});
}

/// What is kept where work is done is H - W, and not H.
TEST(Work, IsAudited) {
  const Folder folder;
  const auto claims_of = [&](const std::string& name, const std::string& quantity) {
    return folder.write(name, "[[claim]]\nquantity = \"" + quantity +
                                  "\"\nmethod = \"hbvm:1,1\"\nrate = 2\nproblem = \"" + driven + "\"\n");
  };
  expect_words(ended_with(0, {"audit", "--claims", claims_of("balance.toml", "balance")}).out, {"1 hold"});
  expect_words(ended_with(1, {"audit", "--claims", claims_of("energy.toml", "H")}).out, {"1 fail"});
}

TEST(Work, OfForcesAtRestThatHaveNoSeriesIsSaid) {
  const Folder folder;
  const std::string at_rest = folder.write("rest.toml", R"(dimension = 1
body = [{ name = "a", mass = 1, position = [1], velocity = [0] }]
effect = [{ kind = "drag", quadratic = 1 }, { kind = "uniform_gravity", acceleration = [-1] }]
)");
  expect_words(ended_with(3, {"reference", at_rest, "--until", "1", "--digits", "10"}).err,
               {"effect 1 (drag)", "square root"});
}

TEST(Work, IsComparedByEveryCommand) {
  expect_words(ended_with(0, {"compare", driven, "--methods", "rk4", "hbvm:3,2", "--step", "1/16", "--until", "1",
                              "--reference"})
                   .out,
               {"hbvm:3,2"});
  expect_words(
      ended_with(0, {"convergence", driven, "--methods", "hbvm:2,2", "--steps", "1/8:1/128", "--until", "1"}).out,
      {"4.0"});
  expect_words(ended_with(0, {"cost", driven, "--until", "1", "--digits", "4"}).out, {"hbvm run"});
  const Folder folder;
  const std::string csv = folder / "run.csv";
  ended_with(0, run_of("hbvm:4,4") + Arguments{"--out", csv});
  expect_words(ended_with(0, {"reference", driven, "--against", csv}).out, {"bob.x"});
}

}  // namespace
}  // namespace hbvm::core
