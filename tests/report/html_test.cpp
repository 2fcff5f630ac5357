#include "report/html.hpp"

#include <gtest/gtest.h>

namespace hbvm::core {
namespace {

TEST(Html, EscapesWhatWouldEndTextOrAttribute) {
  EXPECT_EQ(html("a < b > c & \"d\" 'e' λ"), "a &lt; b &gt; c &amp; &quot;d&quot; &#39;e&#39; λ");
}

TEST(Html, KeepsJsonWithinItsScript) {
  EXPECT_EQ(within_script("{\"a\": \"</script><!--\"}"), "{\"a\": \"\\u003c/script>\\u003c!--\"}");
}

}  // namespace
}  // namespace hbvm::core
