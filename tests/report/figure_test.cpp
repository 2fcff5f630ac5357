#include "hbvm/report/figure.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace hbvm {
namespace {

std::string script(const Panel& panel) {
  Figure figure;
  figure.panels = {panel};
  return gnuplot_script(figure, "x.svg");
}

TEST(Figure, TicsShowThePowersOfLogarithms) {
  Panel panel;
  panel.curves = {{"a.csv", 1, 2, 0, "it's"}};
  EXPECT_NE(script(panel).find("set format '% h'"), std::string::npos);
  panel.logarithms = true;
  EXPECT_NE(script(panel).find("set format x '2^{%g}'"), std::string::npos);
  panel.logarithms = false;
  panel.x_decades = 1;
  panel.y_decades = 2;
  EXPECT_NE(script(panel).find("set format '10^{%g}'\nset xtics 1\nset ytics 2\n"), std::string::npos);
  EXPECT_NE(script(panel).find("title 'it''s'"), std::string::npos);
}

/// In a locale without UTF-8, as it is where nothing is set, gnuplot would warn of a degree sign.
TEST(Figure, IsDrawnInSilenceWhateverTheLocale) {
  const char* const before = std::getenv("LC_ALL");
  const std::string locale = before ? before : "";
  setenv("LC_ALL", "C", 1);
  std::string folder = (std::filesystem::temp_directory_path() / "hbvm_figure_test_XXXXXX").string();
  ASSERT_NE(mkdtemp(folder.data()), nullptr);
  const std::string svg = folder + "/figure.svg";
  Figure figure;
  Panel panel;
  panel.title = "a line";
  panel.lines.push_back({{{"0", "0"}, {"1", "2"}}, "line"});
  figure.panels.push_back(panel);
  testing::internal::CaptureStderr();
  draw(figure, svg);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_GT(std::filesystem::file_size(svg), 1'000u);
  std::filesystem::remove_all(folder);
  if (before)
    setenv("LC_ALL", locale.c_str(), 1);
  else
    unsetenv("LC_ALL");
}

}  // namespace
}  // namespace hbvm
