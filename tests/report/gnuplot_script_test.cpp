#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "hbvm/error.hpp"
#include "hbvm/figure.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::string script(const Panel& panel) {
  Figure figure;
  figure.panels = {panel};
  return gnuplot_script(figure, "x.svg");
}

/// Where a name stands beside the panel, as a share of its height.
double height_of(const std::string& name, const std::string& text) {
  const std::string before = "'" + name + "' at graph 1.02,";
  expect_words(text, {before});
  return std::stod(text.substr(text.find(before) + before.size()));
}

/// What stood in the way of seeing energies of 1e-9: a range of +-0.02 whatever the data.
TEST(GnuplotScript, ShowsSmallNumbersAtTheirSize) {
  Panel panel;
  panel.y.label = "H";
  panel.curves = {{"", {{0, 0}, {1, 1e-9}}}};
  expect_words(script(panel), {"set xrange [0:1]\n", "set yrange [-4e-11:1.04e-09]\n", "set ylabel 'H / 10^{-9}'"});
  EXPECT_FALSE(has(script(panel), "offsets"));
}

TEST(GnuplotScript, NamesCurvesAtTheirEndsAndNotTheOnlyOne) {
  Panel panel;
  panel.curves = {{"it's", {{0, 0}, {1, 1}}}};
  EXPECT_FALSE(has(script(panel), "it''s"));
  panel.curves.push_back({"other", {{0, 0}, {1, 1}}});
  const std::string text = script(panel);
  // At the same place they would stand on each other: 14 of 270 pixels apart, and 1 and 1 are at 0.962 of the height.
  const double other = height_of("other", text), its = height_of("it''s", text);
  EXPECT_NEAR(std::abs(other - its), 14 / 270.0, 1e-4);
  EXPECT_LE(std::max(other, its), 1);
}

TEST(GnuplotScript, NamesAllCurvesBesideThePanelWithTheirMarks) {
  Panel panel;
  panel.labels_beside = true;
  panel.curves = {{"a", {{0, 0}, {1, 1}}, true}, {"b", {{0, 1}, {0.2, 0.5}}, true}};
  expect_words(script(panel),
               {"set label 'a' at graph 1.03,", "set label 'b' at graph 1.03,0.5", "point pt 7", "point pt 5"});
}

/// Gnuplot reads two quotes after an opening one as one of the text; a line that begins with a quote is in double
/// quotes.
TEST(GnuplotScript, WritesAFootnoteInLinesAndPointsWithoutThem) {
  Panel panel;
  panel.curves = {Curve{"", {{0, 1}, {1, 2}}}};
  panel.curves.front().dots = true;
  Figure figure;
  figure.panels = {panel};
  figure.footnote = std::string(70, 'w') + " 'quoted' " + std::string(60, 'v');
  const std::string script = gnuplot_script(figure, "figure.svg");
  expect_words(script, {"set label 3 \"'quoted'", "with points pt 7"});
}

TEST(GnuplotScript, StacksBarsUnderTheirNames) {
  Panel panel;
  panel.x.names = {"double", "two\nlines \"quoted\""};
  panel.bars = {{0, 0, 40, 0}, {0, 40, 100, 1}, {1, 0, 100, 0}};
  expect_words(script(panel), {"set xrange [-0.5:1.5]\n", "set yrange [0:100]\n",
                               "set xtics (\"double\" 0, \"two\\nlines \\\"quoted\\\"\" 1)\n", "-0.35 0.35 40 100\n",
                               "fs solid 1 noborder lc rgb '#D55E00'"});
}

TEST(GnuplotScript, NamesACurveThatEndsWithin) {
  Panel panel;
  panel.curves = {{"a", {{0, 0}, {1, 1}}}, {"b", {{1, 1}, {0.2, 0.5}}}};
  expect_words(script(panel), {"set label 'b' at 0.2,0.5 left"});
}

TEST(GnuplotScript, NamesCurvesThatEndTogetherOneAfterAnother) {
  Panel panel;
  panel.curves = {{"first", {{1, 1}, {0, 0.5}}}, {"second", {{1, 0}, {0, 0.5}}}};
  expect_words(script(panel),
               {"set label 'first' at 0,0.5 left offset 0.7,", "set label 'second' at 0,0.5 left offset 6.7,"});
}

TEST(GnuplotScript, KeepsManyNamesApart) {
  Panel panel;
  for (int i = 0; i < 19; ++i)
    panel.curves.push_back({"c" + std::to_string(i), {{0, 0}, {1, i == 0 ? 1.0 : 1e-3 * i}}});
  const std::string text = script(panel);
  std::vector<double> heights;
  for (int i = 0; i < 19; ++i) heights.push_back(height_of("c" + std::to_string(i), text));
  std::sort(heights.begin(), heights.end());
  EXPECT_GE(heights.front(), 0);
  EXPECT_LE(heights.back(), 1);
  for (std::size_t i = 1; i < heights.size(); ++i) EXPECT_GE(heights[i] - heights[i - 1], 14 / 270.0 - 1e-4);
}

TEST(GnuplotScript, InterruptsCurvesWhereThereIsNoNumber) {
  Panel panel;
  panel.y.scale = AxisScale::decimal;
  panel.curves = {{"", {{0, -INFINITY}, {1, -3}, {2, -INFINITY}, {3, -4}, {4, -5}}}};
  expect_words(script(panel), {"<< EOD\n1 -3\n\n3 -4\n4 -5\nEOD\n"});
  panel.curves = {{"", {{0, -INFINITY}}}};
  expect_words(script(panel), {"plot NaN notitle"});
}

/// 330 pixels show as many units as 270 do: the same length each.
TEST(GnuplotScript, MakesAxesEqual) {
  Panel panel;
  panel.equal_axes = true;
  panel.curves = {{"", {{-1, 0}, {1, 0.1}}}};
  const std::string text = script(panel);
  double x[2], y[2];
  ASSERT_EQ(std::sscanf(text.c_str() + text.find("set xrange ["), "set xrange [%lf:%lf]", x, x + 1), 2);
  ASSERT_EQ(std::sscanf(text.c_str() + text.find("set yrange ["), "set yrange [%lf:%lf]", y, y + 1), 2);
  EXPECT_NEAR((x[1] - x[0]) / 330, (y[1] - y[0]) / 270, 1e-9);
  EXPECT_LT(x[0], -1);
  EXPECT_GT(x[1], 1);
}

TEST(GnuplotScript, LeavesNamesOfScenesAsTheyAre) {
  EXPECT_EQ(plain("a_1^{2}@~&\\"), "a\\_1\\^\\{2\\}\\@\\~\\&\\\\");
  Panel panel;
  panel.marks = {{{0, 0}, Mark::Look::body, "upper_1"}};
  expect_words(script(panel), {"'upper\\_1'"});
}

TEST(GnuplotScript, NamesMarksThatHideEachOtherInOneLine) {
  Panel panel;
  panel.marks = {{{0, 0}, Mark::Look::body, "a"}, {{0, 1e-3}, Mark::Look::body, "b"}, {{1, 1}, Mark::Look::body, "c"}};
  expect_words(script(panel), {"set label 'a, b' at graph 0.02727,", "set label 'c' at graph 0.97273,"});
}

/// Beside its own mark, at the side where the other is not.
TEST(GnuplotScript, WritesNoNameOnAMark) {
  Panel panel;
  panel.marks = {{{0, 0}, Mark::Look::start, ""},
                 {{1, 1}, Mark::Look::start, ""},
                 {{0.5, 0.5}, Mark::Look::body, "left"},
                 {{0.55, 0.5}, Mark::Look::body, "right"}};
  const double beside = 9 / 330.0;
  expect_words(script(panel), {fmt::format("set label 'left' at graph {:.5f},0.50000 right ", 0.5 - beside),
                               fmt::format("set label 'right' at graph {:.5f},0.50000 left ", 0.55 + beside)});
}

/// Else in the grey of its look; a joint covers what it joins.
TEST(GnuplotScript, DrawsLinesInTheColourOfACurve) {
  Panel panel;
  panel.lines = {{{{0, 0}, {1, 1}}, Polyline::Look::solid, 1}, {{{0, 0}, {1, 0}}, Polyline::Look::mesh}};
  panel.lines.push_back({{{0, 0}, {0, 1}}, Polyline::Look::bar, 1, true});
  panel.lines.push_back({{{0, 0}, {0, 1}}, Polyline::Look::axis, 1, true});
  panel.marks = {{{0, 0}, Mark::Look::joint, ""}, {{1, 0}, Mark::Look::body, "", 2}};
  expect_words(script(panel), {"with lines lw 3 dt 2 lc rgb '#D55E00'", "with lines lw 1.2 dt 4 lc rgb '#D55E00'",
                               "pt 7 ps 0.9 lc rgb '#009E73'", "with lines lw 1.6 lc rgb '#D55E00'",
                               "with lines lw 0.4 lc rgb '#c4c4c4'", "pt 7 ps 0.6 lc rgb 'white'", "pt 6 ps 0.6"});
}

TEST(GnuplotScript, QuotesItsTexts) {
  Panel panel;
  panel.title = "the bob's path";
  expect_words(script(panel), {"set title 'the bob''s path'"});
}

TEST(GnuplotScript, RefusesAnotherEnding) {
  EXPECT_THROW(gnuplot_script({}, "picture.jpg"), InputError);
  for (const char* const file : {"a.svg", "b.pdf", "c.png"}) expect_words(gnuplot_script({}, file), {file});
}

}  // namespace
}  // namespace hbvm::core
