#include "study/expected_csv.hpp"

#include <gtest/gtest.h>

#include "folder.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

using Cells = std::vector<std::string>;

ExpectedCsv expected_of(const std::string& text) {
  const Folder folder;
  return ExpectedCsv(folder.write("expected.csv", text));
}

TEST(ExpectedCsvs, AreColumnsAndRows) {
  const ExpectedCsv csv = expected_of("# i,e_y,rate\n\n# a remark, with a comma\n1,2.5e-3,\n2,,3.9\n");
  EXPECT_EQ(csv.columns, (Cells{"i", "e_y", "rate"}));
  ASSERT_EQ(csv.rows.size(), 2u);
  EXPECT_EQ(csv.rows[0], (Cells{"1", "2.5e-3", ""}));
  EXPECT_EQ(csv.rows[1], (Cells{"2", "", "3.9"}));
  EXPECT_EQ(csv.cell(csv.rows[1], "rate"), "3.9");
  EXPECT_EQ(csv.cell(csv.rows[1], "Rate"), "");
}

TEST(ExpectedCsvs, RefuseRowsOfAnotherLength) {
  for (const char* const row : {"1,2", "1,2,3,4", "1,2,3,"}) {
    const std::string csv = std::string("# a,b,c\n1,2,3\n") + row + "\n";
    expect_words(message_of([&] { expected_of(csv); }), {"'" + std::string(row) + "'", "instead of 3"});
  }
  EXPECT_THROW(expected_of("1,2\n"), InputError) << "no columns";
  EXPECT_EQ(expected_of("a,b\n1,2\n").columns, (Cells{"a", "b"})) << "with a # before them or without";
}

TEST(ExpectedCsvs, HoldNumbers) {
  EXPECT_EQ(value_of("2.5e-3"), 1 / double{400});
  EXPECT_THROW(value_of("x"), InputError);
}

}  // namespace
}  // namespace hbvm::core
