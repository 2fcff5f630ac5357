#include "folder_report/svg_picture.hpp"

#include <gtest/gtest.h>

#include "words.hpp"

namespace hbvm::core {
namespace {

/// What would end the attribute or the address is encoded: quotes, "&", "#" and "%", and lines, which browsers drop.
TEST(SvgPicture, StandsInItsAddress) {
  EXPECT_EQ(svg_picture("<svg id=\"p\">\n<path d='M0,0 L1,-1.5'/>&#955; 5 %é</svg>", "f.svg").address,
            "data:image/svg+xml,%3Csvg id=%22p%22%3E%0A%3Cpath d=%27M0,0 L1,-1.5%27/%3E%26%23955; 5 %25%C3%A9"
            "%3C/svg%3E");
}

TEST(SvgPicture, HasTheNumbersOfFiguresBesideIt) {
  const SvgPicture picture =
      svg_picture("<svg><g/><metadata id=\"hbvm-figure\">{\"a\": \"x &lt;b> &amp;amp;\"}</metadata></svg>", "f.svg");
  EXPECT_EQ(picture.address, svg_picture("<svg><g/></svg>", "f.svg").address);
  EXPECT_EQ(picture.data, "{\"a\": \"x <b> &amp;\"}");
  for (const char* const other : {"<svg><metadata>{}</metadata></svg>", "<svg></svg>"})
    EXPECT_EQ(svg_picture(other, "f.svg").data, "");
}

TEST(SvgPicture, SaysWhichLineIsWrong) {
  for (const auto& [text, message] : {std::pair{"<svg>\n<g>", "f.svg:2: <svg> does not end"},
                                      {"<html></html>", "f.svg:1: no drawing: there is no <svg>"}})
    EXPECT_EQ(message_of([&, text = text] { svg_picture(text, "f.svg"); }), message);
}

}  // namespace
}  // namespace hbvm::core
