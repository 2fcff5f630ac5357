#include "csv_line.hpp"

#include <gtest/gtest.h>

namespace hbvm::core {
namespace {

using Cells = std::vector<std::string>;

TEST(CsvLine, QuotesWhatSeparates) {
  EXPECT_EQ(csv_line({"t", "a.x", ""}), "t,a.x,");
  EXPECT_EQ(csv_line({"a,b", "say \"x\"", "two\nlines", "cr\r", "a b", "#"}),
            "\"a,b\",\"say \"\"x\"\"\",\"two\nlines\",\"cr\r\",a b,#");
  EXPECT_EQ(csv_line({}), "");
}

TEST(CsvLine, IsSplitIntoTheSameCells) {
  for (const Cells& cells :
       {Cells{"t", "a.x", "-1.5e-500"}, {"a,b", "\"", "\"\"", ",", "x\"y"}, {"1", "", "2", ""}, {"a", "b\"c\",d"}, {}})
    EXPECT_EQ(split_csv_line(csv_line(cells)), cells);
  EXPECT_EQ(split_csv_line("1,\"\",2"), (Cells{"1", "", "2"}));
  EXPECT_EQ(split_csv_line("a,,b,"), (Cells{"a", "", "b", ""}));
  EXPECT_EQ(split_csv_line(""), Cells{});
  EXPECT_EQ(split_csv_line(","), (Cells{"", ""}));
}

}  // namespace
}  // namespace hbvm::core
