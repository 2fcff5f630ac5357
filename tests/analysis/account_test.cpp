#include "hbvm/analysis/account.hpp"

#include <gtest/gtest.h>

#include <map>
#include <sstream>

#include "hbvm/scene/assemble.hpp"

namespace hbvm {
namespace {

OperationCounts operations(std::initializer_list<std::pair<Op, Index>> counts) {
  OperationCounts result;
  for (const auto& [op, n] : counts) result.add(op, n);
  return result;
}

/// The numbers of each line of the table, by its name; names fill the first 42 columns.
std::map<std::string, std::vector<std::string>> rows(const std::string& text) {
  std::map<std::string, std::vector<std::string>> result;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::string name = line.substr(0, 42);
    name.erase(name.find_last_not_of(' ') + 1);
    std::istringstream cells(line.substr(std::min<std::size_t>(42, line.size())));
    for (std::string cell; cells >> cell;) result[name].push_back(cell);
  }
  return result;
}

Account account() {
  Account account;
  account.steps = 3;
  account.sweeps = 10;
  account.lines = {
      {"spring", true, 10, 20, operations({{Op::add, 1}, {Op::subtract, 2}, {Op::multiply, 30}, {Op::sqrt, 4}}), 1},
      {"coulomb", true, 11, 22, operations({{Op::reciprocal, 5}, {Op::negate, 6}, {Op::cos, 7}}), 2},
      {"projection", false, 12, 0, operations({{Op::subtract, 100}, {Op::exp, 8}}), 5}};
  return account;
}

TEST(AccountText, HasALineForEachAndTheSums) {
  const auto table = rows(to_text(account()));
  using Cells = std::vector<std::string>;
  // calls, evaluations, add and subtract, multiply, divide, sqrt, other, share of 8 seconds
  EXPECT_EQ(table.at("spring"), (Cells{"10", "20", "3", "30", "0", "4", "0", "12.5%"}));
  EXPECT_EQ(table.at("coulomb"), (Cells{"11", "22", "0", "0", "5", "0", "13", "25.0%"}));
  EXPECT_EQ(table.at("all effects"), (Cells{"0", "0", "3", "30", "5", "4", "13", "37.5%"}));
  EXPECT_EQ(table.at("projection"), (Cells{"12", "0", "100", "0", "0", "0", "8", "62.5%"}));
  EXPECT_EQ(table.at("all of the solver"), (Cells{"0", "0", "100", "0", "0", "0", "8", "62.5%"}));
}

TEST(AccountText, BeginsWithStepsAndIterations) {
  EXPECT_TRUE(to_text(account()).starts_with("3 steps, 10 iterations;"));
}

TEST(AccountText, ShowsEffectsBeforeTheSolver) {
  Account mixed = account();
  std::swap(mixed.lines[0], mixed.lines[2]);
  const std::string text = to_text(mixed);
  EXPECT_LT(text.find("coulomb"), text.find("all effects"));
  EXPECT_LT(text.find("spring"), text.find("all effects"));
  EXPECT_LT(text.find("all effects"), text.find("projection"));
  EXPECT_LT(text.find("projection"), text.find("all of the solver"));
}

TEST(AccountText, WithoutTimeHasNoShares) {
  Account untimed = account();
  for (AccountLine& line : untimed.lines) line.seconds = 0;
  for (const auto& [name, cells] : rows(to_text(untimed))) {
    if (name.empty() || name.starts_with("3 steps")) continue;
    EXPECT_EQ(cells.back(), "0.0%") << name;
  }
}

TEST(AccountText, OfNothingHasSumsOfZero) {
  const auto table = rows(to_text(Account{}));
  for (const char* name : {"all effects", "all of the solver"}) {
    ASSERT_TRUE(table.contains(name));
    for (std::size_t i = 0; i + 1 < table.at(name).size(); ++i) EXPECT_EQ(table.at(name)[i], "0");
  }
}

TEST(AccountOf, TheEquationsHasEffectsThenParts) {
  const auto scene = assemble<double>(load_scene("satellites_with_oblateness"));
  const auto method = make_hbvm<double>(3, 2);
  StageEquations<double> equations(scene.problem, method);
  auto x = equations.make_unknowns();
  equations.start({scene.q0, scene.p0, 0.125});
  for (int sweep = 0; sweep < 4; ++sweep) {
    equations.move(x.gamma);
    equations.forces(x.psi);
  }
  const Account account = account_of(equations.problem(), {equations.effect_counts(), equations.part_counts()});
  const std::size_t parts = equations.part_counts().size();
  ASSERT_EQ(account.lines.size(), 2 + parts);
  for (std::size_t i = 0; i < account.lines.size(); ++i) EXPECT_EQ(account.lines[i].effect, i < 2) << i;
  EXPECT_EQ(account.lines[0].name, "central_gravity");
  EXPECT_EQ(account.lines[1].name, "oblateness");
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(account.lines[i].calls, 4u);
    EXPECT_EQ(account.lines[i].evaluations, 12u);
    EXPECT_EQ(account.lines[i].operations, 12 * equations.effect_counts()[i].per_evaluation);
    EXPECT_GT(account.lines[i].operations.total(), 0u);
  }
  for (std::size_t i = 0; i < parts; ++i) {
    const PartCount& part = equations.part_counts()[i];
    EXPECT_EQ(account.lines[2 + i].name, part.name);
    EXPECT_EQ(account.lines[2 + i].calls, part.calls);
    EXPECT_EQ(account.lines[2 + i].operations, part.calls * part.per_call);
  }
}

}  // namespace
}  // namespace hbvm
