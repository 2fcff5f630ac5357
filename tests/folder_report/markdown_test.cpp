#include "folder_report/markdown.hpp"

#include <gtest/gtest.h>

namespace hbvm::core {
namespace {

std::string shown(const std::string& text) {
  return markdown_html(
      text, [](const std::string& address) { return address == "a.svg" ? std::string("<svg/>") : std::string(); });
}

TEST(Markdown, HasHeadingsParagraphsListsAndCode) {
  EXPECT_EQ(shown("# One\n\nTwo\nlines\n\n- a\n  b\n- c\n\n1. d\n"),
            "<h3>One</h3>\n<p>Two lines</p>\n<ul>\n<li>a b</li>\n<li>c</li>\n</ul>\n<ol>\n<li>d</li>\n</ol>\n");
  EXPECT_EQ(shown("```sh\na < b\n```\n\n    c\n    d\n"), "<pre>a &lt; b\n</pre>\n<pre>c\nd\n</pre>\n");
}

TEST(Markdown, HasTables) {
  EXPECT_EQ(shown("| a | b |\n|---|--:|\n| `x` | 1 \\| 2 |\n"),
            "<div class=\"table\"><table>\n<thead><tr><th>a</th><th>b</th></tr>\n</thead><tbody>\n"
            "<tr><td><code>x</code></td><td>1 | 2</td></tr>\n</tbody></table></div>\n");
}

TEST(Markdown, HasStressLinksAndPictures) {
  EXPECT_EQ(
      shown("**a `b`** [c](https://example.org/?a=1&b) [d](e.md) ![f](a.svg) ![g](none.svg) 2 * 3"),
      "<p><strong>a <code>b</code></strong> <a href=\"https://example.org/?a=1&amp;b\" rel=\"noreferrer\">c</a> d "
      "<svg/> g 2 * 3</p>\n");
}

TEST(Markdown, LetsNoTextBeMarkup) {
  EXPECT_EQ(shown("<script>alert(1)</script> & `<b>`\n<!-- a comment -->\n"),
            "<p>&lt;script&gt;alert(1)&lt;/script&gt; &amp; <code>&lt;b&gt;</code></p>\n");
  EXPECT_EQ(shown("[a](javascript:x) [b](https://x\"y)"),
            "<p>a <a href=\"https://x&quot;y\" rel=\"noreferrer\">b</a></p>\n");
}

TEST(Markdown, LeavesWhatDoesNotEndAsItIs) { EXPECT_EQ(shown("a `b **c [d](e"), "<p>a `b **c [d](e</p>\n"); }

}  // namespace
}  // namespace hbvm::core
