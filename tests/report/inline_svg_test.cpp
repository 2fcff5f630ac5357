#include "report/inline_svg.hpp"

#include <gtest/gtest.h>

#include "hbvm/error.hpp"

namespace hbvm::core {
namespace {

std::string kept(const std::string& inside) {
  const std::string svg = inline_svg("<?xml version=\"1.0\"?><svg>" + inside + "</svg>", "d1-", "f.svg").svg;
  EXPECT_TRUE(svg.starts_with("<svg>") && svg.ends_with("</svg>")) << svg;
  return svg.substr(5, svg.size() - 11);
}

TEST(InlineSvg, KeepsWhatDraws) {
  const std::string drawing = "<g stroke=\"red\"><path d='M0,0 L1,1'/><text x=\"1\">a &lt; b</text></g>";
  EXPECT_EQ(kept(drawing), "<g stroke=\"red\"><path d=\"M0,0 L1,1\"/><text x=\"1\">a &lt; b</text></g>");
}

TEST(InlineSvg, LeavesOutWhatActsOrAsksTheNetwork) {
  EXPECT_EQ(kept("<script>alert(1)</script><g onclick=\"x()\" OnLoad='y()'/>"), "<g/>");
  EXPECT_EQ(kept("<image href=\"https://example.org/a.png\"/><style>@import 'x';</style>"), "");
  EXPECT_EQ(kept("<foreignObject><p><b/></p></foreignObject><a href=\"javascript:x\"><path/></a>"), "");
  EXPECT_EQ(kept("<use href=\"https://example.org/a.svg#b\"/><use xlink:href=' java&#115;cript:x'/>"), "<use/><use/>");
  EXPECT_EQ(kept("<g fill=\"url(https://example.org)\" style=\"background:url(x)\"/>"), "<g/>");
  EXPECT_EQ(kept("<!-- <script> --><![CDATA[<b>]]><p>x</p>"), "&lt;b&gt;");
  EXPECT_EQ(kept("<g id='a\"><b>'/>"), "<g id=\"d1-a&quot;>&lt;b>\"/>");
}

TEST(InlineSvg, TellsItsNamesFromThoseOfOtherDrawings) {
  EXPECT_EQ(kept("<circle id=\"p\"/><use xlink:href='#p'/><g clip-path=\"url(#p)\"/>"),
            "<circle id=\"d1-p\"/><use xlink:href=\"#d1-p\"/><g clip-path=\"url(#d1-p)\"/>");
}

TEST(InlineSvg, TakesTheNumbersOfFiguresOutOfIt) {
  const InlineSvg drawing = inline_svg(
      "<svg><g/><metadata id=\"hbvm-figure\">{\"a\": \"x &lt;b> &amp;amp;\"}</metadata></svg>", "d", "f.svg");
  EXPECT_EQ(drawing.svg, "<svg><g/></svg>");
  EXPECT_EQ(drawing.data, "{\"a\": \"x <b> &amp;\"}");
  EXPECT_EQ(inline_svg("<svg><metadata>{}</metadata></svg>", "d", "f.svg").data, "");
}

TEST(InlineSvg, SaysWhichLineIsWrong) {
  for (const auto& [text, message] : {std::pair{"<svg>\n<g>\n</svg>", "f.svg:3: </svg> ends nothing"},
                                      {"<svg>\n<g x=1/></svg>", "f.svg:2: the value of x has no quotes"},
                                      {"<svg><g>", "f.svg:1: <g> does not end"},
                                      {"<html></html>", "f.svg:1: <svg> was expected, not <html>"},
                                      {"no drawing", "f.svg:1: no drawing: there is no <svg>"},
                                      {"<svg>\n<!-- ", "f.svg:2: <!-- does not end"}}) {
    try {
      inline_svg(text, "d", "f.svg");
      ADD_FAILURE() << text;
    } catch (const InputError& error) {
      EXPECT_STREQ(error.what(), message);
    }
  }
}

}  // namespace
}  // namespace hbvm::core
