#include "folder_report/folder_report.hpp"

#include <gtest/gtest.h>

#include "folder.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

struct FolderReportTest : ::testing::Test {
  std::string page() const { return folder_report(folder.path(), "1.2", "hbvm report x"); }
  std::string refusal() const {
    return message_of([&] { page(); });
  }

  Folder folder;
};

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t n = 0;
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += what.size()) ++n;
  return n;
}

TEST_F(FolderReportTest, ShowsTablesDrawingsTextsAndWhatMadeThem) {
  folder.write("README.md", "# A <study>\n\nSee ![it](a.svg).\n");
  folder.write("a.svg", "<svg><g/></svg>");
  folder.write("more/b.svg", "<svg><path/></svg>");
  folder.write("t.csv", "x,y\n1,<b>\n");
  folder.write("t.md", "| x | y |\n|--|--|\n| 1 | 2 |\n");
  folder.write("t.csv-metadata.json",
               R"({"dc:title": "Title", "hbvm:command": "hbvm study x", "hbvm:precision": "quad"})");
  folder.write("cells.jsonl", "{}");
  const std::string text = page();
  expect_words(text, {"<title>A &lt;study&gt;</title>", "<th>precision</th><td>quad</td>", "not shown: cells.jsonl"});
  EXPECT_EQ(count(text, "<figure"), 2u);
  EXPECT_EQ(count(text, "src=\"data:image/svg+xml,%3Csvg%3E%3C"), 2u);
  EXPECT_EQ(count(text, "<td>1</td><td>&lt;b&gt;</td>"), 1u);
  EXPECT_EQ(count(text, "<code>hbvm study x</code>"), 1u);
  EXPECT_EQ(count(text, "<script"), 1u) << "no drawing here says what it draws";
}

TEST_F(FolderReportTest, ShowsSomeRowsOfLongTables) {
  std::string csv = "n\n";
  for (int n = 0; n < 5000; ++n) csv += std::to_string(n) + "\n";
  folder.write("t.csv", csv);
  const std::string text = page();
  expect_words(text, {"400 of 5000 rows"});
  EXPECT_EQ(count(text, "<td>0</td>"), 1u);
  EXPECT_EQ(count(text, "<td>4999</td>"), 1u);
}

TEST_F(FolderReportTest, LeavesOutWhatIsTooLarge) {
  folder.write("large.svg", "<svg><path d=\"" + std::string(report_bytes, '0') + "\"/></svg>");
  folder.write("small.svg", "<svg><path d=\"1\"/></svg>");
  const std::string text = page();
  EXPECT_LT(text.size(), report_bytes);
  expect_words(text, {"large.svg is left out"});
  EXPECT_EQ(count(text, "<figure"), 1u);
}

TEST_F(FolderReportTest, SaysWhatIsWrong) {
  expect_words(refusal(), {"nothing to report in"});
  folder.write("t.csv", "a,b\n1\n");
  EXPECT_EQ(refusal(), folder / "t.csv:2: 1 cells, and the first line names 2 columns");
  folder.write("t.csv", "a,b\n1,2\n");
  folder.write("r.json", "{");
  EXPECT_TRUE(refusal().starts_with(folder / "r.json:1: no JSON")) << refusal();
  folder.write("r.json", "{}");
  folder.write("a.svg", "<svg>");
  EXPECT_EQ(refusal(), folder / "a.svg:1: <svg> does not end");
  EXPECT_THROW(folder_report(folder / "none", "1", "x"), InputError);
}

}  // namespace
}  // namespace hbvm::core
