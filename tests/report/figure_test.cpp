#include "hbvm/report/figure.hpp"

#include <gtest/gtest.h>

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
  panel.decades = true;
  EXPECT_NE(script(panel).find("set format '10^{%g}'"), std::string::npos);
  EXPECT_NE(script(panel).find("title 'it''s'"), std::string::npos);
}

}  // namespace
}  // namespace hbvm
