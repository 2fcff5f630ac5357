#include "report/csv_table.hpp"

#include <gtest/gtest.h>

#include "words.hpp"

namespace hbvm::core {
namespace {

std::string refusal(const std::string& text) {
  return message_of([&] { read_csv_table(text, "f.csv"); });
}

TEST(CsvTable, IsReadWithQuotesAndLinesWithinThem) {
  const CsvTable table = read_csv_table("\xef\xbb\xbfname,value\r\n\"a, \"\"b\"\"\",1\r\n\"two\nlines\",2\n", "f.csv");
  EXPECT_EQ(table.columns, (std::vector<std::string>{"name", "value"}));
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_EQ(table.rows[0], (std::vector<std::string>{"a, \"b\"", "1"}));
  EXPECT_EQ(table.rows[1][0], "two\nlines");
}

TEST(CsvTable, SaysWhichLineIsWrong) {
  EXPECT_EQ(refusal("a,b\n1,2\n\"x\ny\",2\n3\n"), "f.csv:5: 1 cells, and the first line names 2 columns");
  EXPECT_EQ(refusal("a,b\n1,\"2\n"), "f.csv:2: a quote that does not end");
  EXPECT_EQ(refusal(""), "f.csv:1: no line with the names of columns");
  EXPECT_EQ(refusal(std::string("a,b\n1,\0\n", 8)), "f.csv:2: a byte 0, which no CSV has");
}

}  // namespace
}  // namespace hbvm::core
