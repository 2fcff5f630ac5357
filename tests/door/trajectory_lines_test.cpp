#include "door/trajectory_lines.hpp"

#include <gtest/gtest.h>

#include <ostream>

namespace hbvm::core {
namespace {

using Row = std::vector<std::string>;

TEST(TrajectoryLines, HaveARowAsSoonAsALineEnds) {
  TrajectoryLines lines;
  std::ostream out(&lines);
  out << "t,\"a,b.x\"\n0," << 1.5 << '\n' << "1,2\n2,";
  const hbvm::Trajectory first = lines.take();
  EXPECT_EQ(first.columns, (Row{"t", "a,b.x"}));
  EXPECT_EQ(first.rows, (std::vector<Row>{{"0", "1.5"}, {"1", "2"}}));
}

TEST(TrajectoryLines, TakeSeveralLinesAtOnce) {
  TrajectoryLines lines;
  std::ostream out(&lines);
  out << "t\n"
      << "0\n1\n2\n";
  EXPECT_EQ(lines.take().rows, (std::vector<Row>{{"0"}, {"1"}, {"2"}}));
}

TEST(TrajectoryLines, AreNoneBeforeTheFirstEnds) {
  TrajectoryLines lines;
  std::ostream out(&lines);
  out << "t,x";
  const hbvm::Trajectory none = lines.take();
  EXPECT_TRUE(none.columns.empty() && none.rows.empty());
}

}  // namespace
}  // namespace hbvm::core
