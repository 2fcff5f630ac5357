#include <gtest/gtest.h>

#include <numeric>

#include "cost/cost_report.hpp"
#include "cost/findings.hpp"
#include "run/simulate.hpp"

namespace hbvm::core {
namespace {

TEST(Breakdown, StacksTheWholeTimeOfAStep) {
  const Given given = some_findings();
  const Figure figure = breakdown_figure(given.study, given.outcome);
  const Panel& panel = figure.panels.front();
  ASSERT_EQ(panel.x.names.size(), 2u);
  EXPECT_TRUE(panel.x.names[0].starts_with("double")) << panel.x.names[0];
  EXPECT_NE(panel.x.names[1].find("25 ms"), std::string::npos) << panel.x.names[1];
  ASSERT_EQ(panel.bars.size(), 2 * cost_parts.size());
  EXPECT_NEAR(panel.bars[cost_parts.size() - 1].to, 100, 1e-9);
  EXPECT_NEAR(panel.bars[0].to, 25, 1e-9);
}

/// A part that goes by another name would be taken for a correction.
TEST(Breakdown, KnowsThePartsOfAStep) {
  const Assembled<double> scene = assemble<double>(load_scene("double_pendulum"));
  Account account;
  simulate<double>(scene, make_hbvm<double>(6, 4), SolverKind::automatic,
                   TimeGrid<double>(Expression::parse("1/16"), Expression::parse("10")), {}, &account);
  // As if each operation took a second: what a part takes must not depend on what else the machine does.
  for (AccountLine& line : account.lines) line.seconds = static_cast<double>(line.operations.total());
  const auto shares = part_shares(account.lines, true), apart = part_shares(account.lines, false);
  for (const auto& all : {shares, apart}) EXPECT_NEAR(std::accumulate(all.begin(), all.end(), double{0}), 1, 1e-9);
  EXPECT_GT(shares[4], 0);
  EXPECT_NEAR(shares[1] + shares[4], apart[1] + apart[4], 1e-9);
  EXPECT_GT(apart[1], shares[1]);
  EXPECT_GT(shares[1], shares[0]);  // of two rods and gravity
  EXPECT_GT(shares[2], 0);
  EXPECT_LT(shares[3], 0.4);
}

}  // namespace
}  // namespace hbvm::core
