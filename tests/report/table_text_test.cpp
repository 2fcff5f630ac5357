#include <gtest/gtest.h>

#include "hbvm/figure.hpp"
#include "hbvm/table.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

const Table table{"A caption",
                  {"hbvm 1.2.3"},
                  {"k", "s"},
                  {"i", "e_y", "rate_y", "e_lambda"},
                  {{"s = 1", {"3", "1"}, {{"0", "1.00e-01", "---", "2.0e-1"}, {"1", "2.50e-02", "2.0", "1.0e-1"}}},
                   {"s = 2", {"4", "2"}, {{"0", "1.00e-03", "***", "7.0e-9"}}}}};

TEST(Table, CsvNamesItsColumnsFirstAndRepeatsTheKeys) {
  EXPECT_EQ(to_csv(table),
            "k,s,i,e_y,rate_y,e_lambda\n3,1,0,1.00e-01,---,2.0e-1\n3,1,1,2.50e-02,2.0,1.0e-1\n"
            "4,2,0,1.00e-03,***,7.0e-9\n");
  EXPECT_EQ(csv_columns(table), (std::vector<std::string>{"k", "s", "i", "e_y", "rate_y", "e_lambda"}));
}

TEST(Table, MarkdownHasATableForEachGroup) {
  EXPECT_EQ(to_markdown(table),
            "**A caption**\n\ns = 1\n\n| i | e_y | rate_y | e_lambda |\n|---:|---:|---:|---:|\n"
            "| 0 | 1.00e-01 | --- | 2.0e-1 |\n| 1 | 2.50e-02 | 2.0 | 1.0e-1 |\n\ns = 2\n\n"
            "| i | e_y | rate_y | e_lambda |\n|---:|---:|---:|---:|\n| 0 | 1.00e-03 | *** | 7.0e-9 |\n\n"
            "<!-- hbvm 1.2.3 -->\n");
}

TEST(Table, LatexHasThePapersLayout) {
  const std::string text = to_latex(table);
  expect_words(text, {"\\multicolumn{4}{|c|}{$s = 1$}\\\\", "$i$ & $e_{y}$ & rate & $e_{\\lambda}$\\\\",
                      "1 & 2.50e-02 & 2.0 & 1.0e-1\\\\"});
  EXPECT_EQ(text.find("% hbvm 1.2.3"), 0u);
}

TEST(Table, LatexShowsTextAsItIs) {
  expect_words(to_latex({"", {}, {}, {"scene"}, {{"", {}, {{"heavy_top, k > s"}}}}}), {"\nheavy\\_top, k $>$ s\\\\\n"});
}

/// An underscore outside a formula stops LaTeX.
TEST(Table, LatexHasNoUnderscoreOutsideAFormula) {
  const std::string text = to_latex({"Long runs of a_b, 5 %",
                                     {},
                                     {},
                                     {"output_delta_H", "two_words_here", "e_g_max", "a%"},
                                     {{"", {}, {{"1", "2", "3", "4"}}}}});
  expect_words(text, {"\\caption{Long runs of a\\_b, 5 \\%}",
                      "\noutput $\\delta H$ & two words here & $e_{\\mathrm{g\\_max}}$ & a\\%\\\\\n"});
}

TEST(Table, LatexOfManyRowsMayBreakAcrossPages) {
  Table many{"Many", {}, {}, {"a", "+-"}, {{"heavy_top", {}, {{">= 2", "1"}}}}};
  const std::string one = to_latex(many);
  expect_words(one, {"\\multicolumn{2}{|c|}{heavy\\_top}\\\\", "\n$a$ & $\\pm$\\\\", "\n$\\ge$ 2 & 1\\\\"});
  EXPECT_TRUE(one.ends_with("\\end{table}\n"));
  many.groups[0].rows.resize(51, {"x", "y"});
  const std::string text = to_latex(many);
  EXPECT_EQ(text.find("\\begin{longtable}{|cc|}\n\\caption{Many}\\\\\n\\hline"), 0u) << text;
  EXPECT_TRUE(text.ends_with("\\end{longtable}\n"));
}

TEST(Table, TextHasItsColumnsAligned) {
  EXPECT_EQ(to_text({"", {}, {}, {"claim", "k"}, {{"kepler", {}, {{"ord2s", "12"}, {"a longer one", ""}}}}}),
            "kepler\n  claim         k\n  ord2s         12\n  a longer one\n\n");
}

TEST(Table, KeepsWhatSeparatesCells) {
  const Table separators{"", {}, {}, {"a", "b"}, {{"", {}, {{"HBVM(3,2) \"Gauss\"", "x | y & 5 %"}}}}};
  expect_words(to_csv(separators), {"\n\"HBVM(3,2) \"\"Gauss\"\"\",x | y & 5 %\n"});
  expect_words(to_markdown(separators), {"| HBVM(3,2) \"Gauss\" | x \\| y & 5 % |"});
  expect_words(to_latex(separators), {"HBVM(3,2) \"Gauss\" & x | y \\& 5 \\%\\\\"});
}

}  // namespace
}  // namespace hbvm::core
