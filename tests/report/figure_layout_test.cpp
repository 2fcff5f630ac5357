#include "report/figure_layout.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace hbvm::core {
namespace {

Figure two_panels() {
  Panel panel;
  panel.title = "one\\_panel";
  panel.x = {"digits", AxisScale::linear};
  panel.y = {"error", AxisScale::falling};
  panel.curves = {{"a", {{1, 2}, {3, -4}, {NAN, 1}}}, {"b", {{2, 0.1}}}};
  Panel bars;
  bars.x.names = {"x"};
  bars.curves = {{"part", {}}};
  bars.bars = {{0, 10, 25, 0}};
  Figure figure;
  figure.panels = {panel, bars};
  figure.footnote = "note";
  return figure;
}

TEST(FigureLayout, StandsPanelsBesideOneAnother) {
  const FigureLayout layout = layout_of(two_panels());
  ASSERT_EQ(layout.panels.size(), 2u);
  EXPECT_EQ(layout.panels[0].bottom, layout.panels[1].bottom);
  EXPECT_GT(layout.panels[1].left, layout.panels[0].left + box_width);
  EXPECT_LT(layout.panels[1].left + box_width, layout.size[0]);
  EXPECT_EQ(layout.panels[0].x.from, 1);
  EXPECT_EQ(layout.panels[0].x.to, 3);
  EXPECT_LT(layout.panels[0].y.from, -4);
}

TEST(FigureLayout, SaysWhatIsDrawnWhere) {
  const Figure figure = two_panels();
  const auto data = nlohmann::json::parse(figure_data(figure));
  const FigureLayout layout = layout_of(figure);
  ASSERT_EQ(data["panels"].size(), 2u);
  const auto& first = data["panels"][0];
  EXPECT_EQ(first["title"], "one_panel");
  EXPECT_EQ(first["y"]["scale"], "falling");
  EXPECT_EQ(first["curves"][0]["points"].dump(), "[[1.0,2.0],[3.0,-4.0]]");
  EXPECT_EQ(first["curves"][1]["points"].dump(), "[[2.0,0.1]]");
  EXPECT_EQ(first["box"][1].get<double>(), layout.size[1] - layout.panels[0].bottom - box_height);
  const auto& bar = data["panels"][1]["curves"][0];
  EXPECT_EQ(bar["label"], "part");
  EXPECT_EQ(bar["value"], 15);
  EXPECT_EQ(bar["points"].dump(), "[[0.0,17.5]]");
}

/// A letter is 7 pixels wide at most; a mark stands before them.
TEST(FigureLayout, HasRoomForNamesBesideAPanel) {
  Figure figure = two_panels();
  figure.panels.pop_back();
  figure.panels[0].labels_beside = true;
  figure.panels[0].curves[0] = {"hbvm:12,10", {{1, 2}}, true};
  const FigureLayout layout = layout_of(figure);
  EXPECT_GE(layout.size[0], layout.panels[0].left + box_width + 22 + 7 * 10 + 10);
}

/// A command that made a figure is longer than the figure is wide: no word of it is lost, and no line is cut.
TEST(FigureLayout, BreaksAFootnoteIntoLines) {
  Figure figure = two_panels();
  const FigureLayout before = layout_of(figure);
  EXPECT_EQ(before.footnote, std::vector<std::string>{"note"});
  const std::string word(40, 'w'), endless(400, 'e');
  figure.footnote = endless + " " + word + " " + word + " " + word + " " + word + " 'quoted'";
  const FigureLayout layout = layout_of(figure);
  ASSERT_GT(layout.footnote.size(), 3u);
  EXPECT_EQ(layout.size[1], before.size[1] + line_height * static_cast<double>(layout.footnote.size() - 1));
  std::string all;
  for (const std::string& line : layout.footnote) {
    EXPECT_LE(static_cast<double>(line.size()) * 5, layout.size[0]) << line;
    EXPECT_GE(line.size(), 8u) << line;
    all += line;
  }
  std::erase(all, ' ');
  EXPECT_EQ(all, endless + word + word + word + word + "'quoted'");
  figure.footnote = "";
  EXPECT_TRUE(layout_of(figure).footnote.empty());
}

TEST(FigureLayout, CountsLettersNotBytes) { EXPECT_EQ(letters("λ°a"), 3u); }

}  // namespace
}  // namespace hbvm::core
