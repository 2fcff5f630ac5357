#include "run/account.hpp"

#include <gtest/gtest.h>

#include <map>
#include <sstream>

#include "scene/assemble.hpp"
#include "words.hpp"

namespace hbvm::core {
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

using Kind = AccountLine::Kind;

Account account() {
  Account account;
  account.steps = 3;
  account.sweeps = 10;
  account.lines = {
      {"spring", Kind::effect, 10, 20, operations({{Op::add, 1}, {Op::subtract, 2}, {Op::multiply, 30}, {Op::sqrt, 4}}),
       1},
      {"coulomb", Kind::effect, 11, 22, operations({{Op::reciprocal, 5}, {Op::negate, 6}, {Op::cos, 7}}), 2},
      {"unused", Kind::part},
      {"projection", Kind::part, 12, 0, operations({{Op::subtract, 100}, {Op::exp, 8}}), 5},
      {"factors", Kind::in_double, 7, 0, operations({{Op::multiply, 1000}}), 1},
      {"rest of the steps", Kind::rest, 0, 0, {}, 1}};
  return account;
}

TEST(AccountText, HasALineForEachAndTheSums) {
  const auto table = rows(to_text(account()));
  using Cells = std::vector<std::string>;
  // calls, evaluations, add and subtract, multiply, divide, sqrt, other, share of 10 seconds
  EXPECT_EQ(table.at("spring"), (Cells{"10", "20", "3", "30", "0", "4", "0", "10.0%"}));
  EXPECT_EQ(table.at("coulomb"), (Cells{"11", "22", "0", "0", "5", "0", "13", "20.0%"}));
  EXPECT_EQ(table.at("all effects"), (Cells{"3", "30", "5", "4", "13", "30.0%"}));
  EXPECT_EQ(table.at("projection"), (Cells{"12", "100", "0", "0", "0", "8", "50.0%"}));
  EXPECT_EQ(table.at("all parts"), (Cells{"100", "0", "0", "0", "8", "50.0%"}));
  EXPECT_EQ(table.at("all in double"), (Cells{"0", "1000", "0", "0", "0", "10.0%"}));
  EXPECT_EQ(table.at("rest of the steps"), (Cells{"10.0%"}));
  EXPECT_FALSE(table.contains("unused"));
}

TEST(AccountText, BeginsWithStepsAndIterations) {
  EXPECT_TRUE(to_text(account()).starts_with("3 steps, 10 iterations\n"));
}

TEST(AccountText, ShowsEffectsThenTheSolverThenWhatIsInDouble) {
  Account mixed = account();
  std::swap(mixed.lines[0], mixed.lines[4]);
  const std::string text = to_text(mixed);
  std::size_t last = 0;
  for (const char* name :
       {"coulomb", "all effects", "projection", "all parts", "factors", "all in double", "rest of"}) {
    EXPECT_GT(text.find(name), last) << name;
    last = text.find(name);
  }
}

/// Neither sums of nothing nor headings without lines.
TEST(AccountText, LeavesOutWhatIsNot) {
  const std::string text = to_text(Account{});
  for (const char* word : {"all ", "effects,", "in double", "rest"}) EXPECT_EQ(text.find(word), std::string::npos);
}

TEST(AccountText, WithoutTimeHasNoShares) {
  Account untimed = account();
  for (AccountLine& line : untimed.lines) line.seconds = 0;
  for (const auto& [name, cells] : rows(to_text(untimed))) {
    if (cells.empty() || !cells.back().ends_with('%')) continue;
    EXPECT_EQ(cells.back(), "0.0%") << name;
  }
}

TEST(AccountBalance, BringsElapsedTimeToThatOfTheProcessorAndAddsTheRest) {
  const auto expect_balanced = [](double cpu_seconds, double elapsed_seconds, double first, double rest) {
    Account timed = account();
    timed.lines.pop_back();  // 9 seconds are left
    balance(timed, cpu_seconds, elapsed_seconds);
    EXPECT_EQ(timed.lines[0].seconds, first);
    EXPECT_EQ(timed.lines.back().kind, Kind::rest);
    EXPECT_EQ(timed.lines.back().seconds, rest);
    double sum = 0;
    for (const AccountLine& line : timed.lines) sum += line.seconds;
    EXPECT_EQ(sum, cpu_seconds);
  };
  constexpr double half = 1 / double{2};
  expect_balanced(8, 16, half, 7 * half);
  // A clock of the processor that runs a little faster is none.
  expect_balanced(10, 9, 1, 1);
  // Nor is a line that was held up longer than all steps: 9 seconds of 8.
  expect_balanced(9 * half, 8, half, 0);
}

/// Parts of solvers with other numbers of nodes are one line, each with its own operations.
TEST(AccountParts, OfTheSameNameAreOneLine) {
  Account account;
  add_parts(account, {{"a", 2, operations({{Op::add, 10}}), 1},
                      {"b", 1, operations({{Op::add, 1}}), 1},
                      {"a", 3, operations({{Op::add, 100}}), 2},
                      {"a", 5, operations({{Op::multiply, 1}}), 4, true}});
  ASSERT_EQ(account.lines.size(), 3u);
  EXPECT_EQ(account.lines[0].calls, 5u);
  EXPECT_EQ(account.lines[0].operations, operations({{Op::add, 320}}));
  EXPECT_EQ(account.lines[0].seconds, 3);
  EXPECT_EQ(account.lines[1].name, "b");
  EXPECT_EQ(account.lines[2].kind, Kind::in_double);
  EXPECT_EQ(account.lines[2].operations, operations({{Op::multiply, 5}}));
}

/// Below the sum over the effects, which is that of their formulas.
TEST(AccountText, SaysWhatWasNotDoneAgain) {
  Account account{{{"a", Kind::effect, 3, 6, operations({{Op::sqrt, 60}}), 1},
                   {"b", Kind::effect, 3, 6, operations({{Op::sqrt, 70}}), 1}}};
  EXPECT_EQ(to_text(account).find("not done again"), std::string::npos);
  account.lines[1].done_before = operations({{Op::sqrt, 50}});
  const std::string text = to_text(account);
  const auto sum = text.find("all effects"), again = text.find("of these not done again");
  ASSERT_NE(again, std::string::npos);
  EXPECT_LT(sum, again);
  expect_words(text.substr(sum, again - sum), {"130"});
  expect_words(text.substr(again), {" 50"});
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
  for (std::size_t i = 0; i < account.lines.size(); ++i)
    EXPECT_EQ(account.lines[i].kind, i < 2 ? Kind::effect : Kind::part) << i;
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
}  // namespace hbvm::core
